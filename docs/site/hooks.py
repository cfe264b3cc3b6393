"""Changes to pages that the settings of mkdocs cannot express."""
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parent))
import pages  # noqa: E402


def on_config(config):
    config["mdx_configs"]["toc"]["slugify"] = lambda text, separator: pages.slug(text)
    return config


def on_post_build(config):
    """Pages opened as files may not fetch the search index: it is there as a script, too."""
    search = Path(config["site_dir"]) / "search"
    index = (search / "search_index.json").read_text()
    (search / "search_index.js").write_text(f"var __search = {{index: Promise.resolve({index})}};\n")
