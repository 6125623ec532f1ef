"""What every room of the service may read: problems, headers, codings, files that are private or replaced whole."""
