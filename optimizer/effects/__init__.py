"""Which output needs which effect needs which input: only what a scene calls for is simulated."""
