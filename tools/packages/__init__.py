"""Parts of tools/dist."""
