"""Changes to the site that mkdocs has no settings for."""
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parent))
import pages  # noqa: E402


def on_config(config):
    config["mdx_configs"]["toc"]["slugify"] = lambda text, separator: pages.slug(text)
    return config


def on_post_build(config):
    """Writes the search index as a script, too, because pages opened as files cannot fetch it."""
    search = Path(config["site_dir"]) / "search"
    index = (search / "search_index.json").read_text()
    (search / "search_index.js").write_text(f"var __search = {{index: Promise.resolve({index})}};\n")
