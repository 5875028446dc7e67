"""The explorer: carom's own engine in the browser, compiled to WebAssembly."""
