"""install_files.py CMAKE BUILD PREFIX SOURCE: installs, and looks at what was installed."""

import shutil
import subprocess
import sys
from pathlib import Path

cmake, build, prefix, source = sys.argv[1], sys.argv[2], Path(sys.argv[3]), Path(sys.argv[4])
shutil.rmtree(prefix, ignore_errors=True)
subprocess.run([cmake, "--install", build, "--prefix", prefix], check=True,
               stdout=subprocess.DEVNULL)

tool = prefix / "bin" / "lambent"
version = subprocess.run([tool, "--version"], check=True, capture_output=True, text=True).stdout
assert version.startswith("lambent "), version

share = prefix / "share"
for wanted in ("man/man1/lambent.1", "man/man1/lambent-bake.1", "man/man1/lambent-info.1",
               "bash-completion/completions/lambent", "zsh/site-functions/_lambent",
               "fish/vendor_completions.d/lambent.fish", "lambent/json/common.schema.json",
               "lambent/json/bake.schema.json"):
    assert (share / wanted).stat().st_size > 500, f"{wanted} was not installed"

config = next(prefix.rglob("lambentConfig.cmake"))
for file in config.parent.glob("*.cmake"):
    text = file.read_text()
    assert str(source) not in text, f"{file} names the source folder"
    assert str(build) not in text, f"{file} names the build folder"

headers = {str(header.relative_to(prefix / "include")) for header in prefix.rglob("*.h")}
for wanted in ("lambent/sh/rotation.h", "lambent/macro/bake.h", "lambent/shade/shade.h"):
    assert wanted in headers, f"{wanted} was not installed"
assert not [h for h in headers if "test" in Path(h).name], "test headers were installed"
assert not list(prefix.rglob("*.cpp")), "sources were installed"
