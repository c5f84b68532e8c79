"""Builds the wheel (PEP 517) with CMake and what Debian has, where a build backend would have to be downloaded."""

import base64
import hashlib

import pathlib
import subprocess
import sysconfig
import tempfile
import tomllib
import zipfile

HERE = pathlib.Path(__file__).resolve().parents[1]
ROOT = HERE.parents[1]


def build_wheel(wheel_directory, config_settings=None, metadata_directory=None):
    """config_settings: build-dir, a configured build folder to take the module from."""
    build = pathlib.Path((config_settings or {}).get("build-dir", ROOT / "build")).resolve()
    if not (build / "CMakeCache.txt").exists():
        subprocess.run(["cmake", "--preset", "release", "-B", build], cwd=ROOT, check=True)
    subprocess.run(["cmake", "--build", build, "--target", "talus-python"], check=True)
    name = f"talus-{_version(build)}-{_tag()}.whl"
    with tempfile.TemporaryDirectory() as prefix:
        subprocess.run(["cmake", "--install", build, "--component", "python", "--strip", "--prefix", prefix], check=True)
        package = next(pathlib.Path(prefix).rglob("_core*.so")).parent
        _write(pathlib.Path(wheel_directory) / name, package, _version(build))
    return name


def _version(build):
    lines = (build / "CMakeCache.txt").read_text().splitlines()
    return next(line.partition("=")[2] for line in lines if line.startswith("CMAKE_PROJECT_VERSION:"))


def _tag():
    """For this interpreter's version on this platform: the module is built for both."""
    version = sysconfig.get_config_var("py_version_nodot")
    platform = sysconfig.get_platform().replace("-", "_").replace(".", "_")
    return f"cp{version}-cp{version}-{platform}"


def _write(path, package, version):
    with open(HERE / "pyproject.toml", "rb") as file:
        project = tomllib.load(file)["project"]
    info = f"talus-{version}.dist-info"
    metadata = (
        f"Metadata-Version: 2.1\nName: talus\nVersion: {version}\nSummary: {project['description']}\n"
        f"Requires-Python: {project['requires-python']}\n"
        + "".join(f"Requires-Dist: {each}\n" for each in project["dependencies"])
    )
    files = {f"talus/{file.name}": file.read_bytes() for file in sorted(package.iterdir())}
    files[f"{info}/METADATA"] = metadata.encode()
    files[f"{info}/WHEEL"] = f"Wheel-Version: 1.0\nGenerator: talus\nRoot-Is-Purelib: false\nTag: {_tag()}\n".encode()
    record = "".join(f"{name},{_digest(data)},{len(data)}\n" for name, data in files.items())
    files[f"{info}/RECORD"] = f"{record}{info}/RECORD,,\n".encode()
    with zipfile.ZipFile(path, "w", zipfile.ZIP_DEFLATED) as wheel:
        for name, data in files.items():
            entry = zipfile.ZipInfo(name)
            entry.external_attr = 0o644 << 16
            wheel.writestr(entry, data, zipfile.ZIP_DEFLATED)


def _digest(data):
    return "sha256=" + base64.urlsafe_b64encode(hashlib.sha256(data).digest()).rstrip(b"=").decode()


