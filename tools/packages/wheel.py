"""The wheel: the program as a script, and the Python package beside it. It has no extension module, so that one wheel serves
every Python."""

import base64
import hashlib
import zipfile

from .version import LICENSE, MANIFEST, ROOT, SUMMARY, VERSION, is_python_package_of_this_version

NAME = "ttb_cosim"
METADATA = f"""\
Metadata-Version: 2.1
Name: ttb-cosim
Version: {VERSION}
Summary: {SUMMARY}
License: {MANIFEST["license"]}
Requires-Python: >=3.9
Provides-Extra: frames
Requires-Dist: pandas; extra == "frames"
Classifier: License :: OSI Approved :: MIT License
Classifier: Operating System :: Microsoft :: Windows
Classifier: Operating System :: POSIX :: Linux
Classifier: Topic :: Scientific/Engineering
Classifier: Typing :: Typed
Description-Content-Type: text/markdown

"""


def make(program, target, output):
    """Writes the wheel; the same program gives the same bytes. One for this machine alone is packed fast."""
    if not is_python_package_of_this_version():
        raise SystemExit(f"tools/dist: python/ttb/__init__.py must say __version__ = \"{VERSION}\", as Cargo.toml does")
    info = f"{NAME}-{VERSION}.dist-info"
    tags = "".join(f"Tag: py3-none-{tag}\n" for tag in target.wheel_tag.split("."))
    package = sorted((ROOT / "python/ttb").glob("*.py")) + [ROOT / "python/ttb/py.typed"]
    files = {f"ttb/{path.name}": path.read_bytes() for path in package}
    files |= {
        f"{NAME}-{VERSION}.data/scripts/ttb{target.suffix}": program.read_bytes(),
        f"{info}/METADATA": METADATA.encode() + (ROOT / "docs/guide/python.md").read_bytes(),
        f"{info}/WHEEL": f"Wheel-Version: 1.0\nGenerator: ttb tools/dist\nRoot-Is-Purelib: false\n{tags}".encode(),
        f"{info}/licenses/LICENSE": LICENSE.read_bytes(),
    }
    record = "".join(f"{name},sha256={_digest(content)},{len(content)}\n" for name, content in files.items())
    files[f"{info}/RECORD"] = f"{record}{info}/RECORD,,\n".encode()
    path = output / f"{NAME}-{VERSION}-py3-none-{target.wheel_tag}.whl"
    with zipfile.ZipFile(path, "w") as archive:
        for name, content in files.items():
            entry = zipfile.ZipInfo(name, (1980, 1, 1, 0, 0, 0))
            entry.compress_type = zipfile.ZIP_DEFLATED
            entry.external_attr = (0o100755 if "/scripts/" in name else 0o100644) << 16
            archive.writestr(entry, content, compresslevel=1 if target.triple is None else 9)
    return path


def _digest(content):
    return base64.urlsafe_b64encode(hashlib.sha256(content).digest()).rstrip(b"=").decode()
