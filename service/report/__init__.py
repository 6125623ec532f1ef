"""The report: an answer of the service as a document to be read, printed and filed."""
