# SPDX-License-Identifier: Apache-2.0
"""What pip builds the Python module with: CMake, and the libraries that there are. Nothing is downloaded.

A PEP 517 backend. `pip install .` runs CMake in build/python-cp311 (or so), which is kept: the next time only what has
changed is compiled. Settings, as in `pip install . --config-settings cmake-args=-DSPHERETREE_WITH_ASSIMP=OFF`:

    cmake-args   further arguments for CMake, as a shell would take them
    built        a folder that CMake has built the module in: nothing is compiled
    backend      scikit-build-core, to hand everything over to that package, which must be there
                 (pip install . --no-build-isolation); [tool.scikit-build] of pyproject.toml is for it

Steps: compile() -> install() -> pack(), for a wheel; build_sdist() takes what git knows.
"""
import base64
import hashlib
import io
import os
import pathlib
import re
import shlex
import shutil
import subprocess
import sys
import sysconfig
import tarfile
import tempfile
import zipfile

ROOT = pathlib.Path(__file__).resolve().parent.parent
NAME = "spheretree"
SUMMARY = "Sphere-trees of volumes: ever fewer spheres that cover every voxel of an object"


def version():
    return re.search(r"project\(openvdb_spheretree VERSION (\S+)", (ROOT / "CMakeLists.txt").read_text())[1]


def metadata():
    return (f"Metadata-Version: 2.1\nName: {NAME}\nVersion: {version()}\nSummary: {SUMMARY}\nLicense: Apache-2.0\n"
            "Requires-Python: >=3.9\nRequires-Dist: numpy\nDescription-Content-Type: text/markdown\n\n"
            + (ROOT / "docs/python.md").read_text())


def tag():
    """Of this Python on this machine: libraries are the machine's own, so the wheel is for nobody else."""
    python = f"cp{sys.version_info.major}{sys.version_info.minor}"
    return f"{python}-{python}-{re.sub(r'[^a-z0-9]', '_', sysconfig.get_platform().lower())}"


def run(*arguments):
    try:
        subprocess.run([str(argument) for argument in arguments], check=True)
    except FileNotFoundError:
        sys.exit(f"there is no {arguments[0]}; on Debian: apt-get install cmake g++ ninja-build")
    except subprocess.CalledProcessError as error:
        sys.exit(f"{arguments[0]} has failed (exit code {error.returncode}); what it needs stands above, by the names of "
                 "Debian's packages")


def jobs():
    """Compilers at once: one a core, but no more than there is memory for (1.5 GiB each: OpenVDB's templates)."""
    if os.environ.get("CMAKE_BUILD_PARALLEL_LEVEL"):
        return os.environ["CMAKE_BUILD_PARALLEL_LEVEL"]
    cores = len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else os.cpu_count() or 1
    try:
        available = int(re.search(r"MemAvailable:\s+(\d+)", pathlib.Path("/proc/meminfo").read_text())[1])
    except (OSError, TypeError):
        return cores
    return max(1, min(cores, available // 1572864))


def compile(settings):
    """Returns the folder of the build."""
    folder = ROOT / "build" / f"python-{tag().split('-')[0]}"
    generator = [] if (folder / "CMakeCache.txt").exists() or not shutil.which("ninja") else ["-GNinja"]
    run("cmake", "-S", ROOT, "-B", folder, *generator, "-DCMAKE_BUILD_TYPE=Release", "-DSPHERETREE_BUILD_PYTHON=ON",
        "-DSPHERETREE_BUILD_EXAMPLES=OFF", f"-DPython_EXECUTABLE={sys.executable}", *shlex.split(settings.get("cmake-args", "")))
    run("cmake", "--build", folder, "--target", "spheretree_python", "-j", jobs())
    return folder


def install(folder, staging):
    run("cmake", "--install", folder, "--component", "python", "--prefix", staging, "--strip")


def pack(staging, path):
    """The folder as a wheel, with its list of files and their sums."""
    about = f"{NAME}-{version()}.dist-info"
    wheel = f"Wheel-Version: 1.0\nGenerator: {NAME}\nRoot-Is-Purelib: false\nTag: {tag()}\n"
    record = []
    with zipfile.ZipFile(path, "w", zipfile.ZIP_DEFLATED) as archive:
        def add(name, content):
            entry = zipfile.ZipInfo(name)  # of a fixed time: the same files give the same wheel
            entry.external_attr = 0o644 << 16
            entry.compress_type = zipfile.ZIP_DEFLATED
            archive.writestr(entry, content)
            digest = base64.urlsafe_b64encode(hashlib.sha256(content).digest()).rstrip(b"=").decode()
            record.append(f"{name},sha256={digest},{len(content)}")

        for file in sorted(path for path in staging.rglob("*") if path.is_file()):
            add(file.relative_to(staging).as_posix(), file.read_bytes())
        add(f"{about}/METADATA", metadata().encode())
        add(f"{about}/WHEEL", wheel.encode())
        add(f"{about}/LICENSE", (ROOT / "LICENSE").read_bytes())
        record.append(f"{about}/RECORD,,")
        archive.writestr(zipfile.ZipInfo(f"{about}/RECORD"), "\n".join(record) + "\n")


def other_backend(settings):
    """The module of another backend that is asked for, or None."""
    name = settings.get("backend")
    if name is None:
        return None
    if name != "scikit-build-core":
        sys.exit(f"backend={name} is unknown: it takes scikit-build-core")
    try:
        import scikit_build_core.build
    except ImportError:
        sys.exit("backend=scikit-build-core: it is not installed here, or pip hides it; add --no-build-isolation")
    return scikit_build_core.build


# ---- What pip calls


def build_wheel(wheel_directory, config_settings=None, metadata_directory=None):
    settings = dict(config_settings or {})
    other = other_backend(settings)
    if other:
        return other.build_wheel(wheel_directory, {}, metadata_directory)
    folder = settings.get("built") or compile(settings)
    name = f"{NAME}-{version()}-{tag()}.whl"
    with tempfile.TemporaryDirectory() as staging:
        install(folder, staging)
        pack(pathlib.Path(staging), pathlib.Path(wheel_directory) / name)
    return name


def prepare_metadata_for_build_wheel(metadata_directory, config_settings=None):
    about = pathlib.Path(metadata_directory) / f"{NAME}-{version()}.dist-info"
    about.mkdir()
    (about / "METADATA").write_text(metadata())
    (about / "WHEEL").write_text(f"Wheel-Version: 1.0\nGenerator: {NAME}\nRoot-Is-Purelib: false\nTag: {tag()}\n")
    return about.name


def build_sdist(sdist_directory, config_settings=None):
    listed = subprocess.run(["git", "ls-files", "-z"], cwd=ROOT, check=True, capture_output=True, text=True).stdout
    stem = f"{NAME}-{version()}"
    with tarfile.open(pathlib.Path(sdist_directory) / f"{stem}.tar.gz", "w:gz") as archive:
        for name in filter(None, listed.split("\0")):
            archive.add(ROOT / name, f"{stem}/{name}")
        content = metadata().encode()
        entry = tarfile.TarInfo(f"{stem}/PKG-INFO")
        entry.size = len(content)
        archive.addfile(entry, io.BytesIO(content))
    return f"{stem}.tar.gz"
