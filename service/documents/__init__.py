"""What the service says about itself: documents that go in and out, examples, the reference page."""
