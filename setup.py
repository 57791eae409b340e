"""The compiled modules; everything else is declared in pyproject.toml."""

import os
import sysconfig
import tomllib
from pathlib import Path

from setuptools import Extension, setup
from setuptools.command.build_ext import build_ext
from setuptools.modified import newer_group

# -ffp-contract=off: a fused a*b + c rounds once where the interpreter rounds twice, and the same file has to
# give the same numbers compiled and uncompiled. -g0: debug symbols would be four fifths of each file. Nothing
# depends on the machine that builds, so wheels run elsewhere.
UNIX_FLAGS = ["-O3", "-ffp-contract=off", "-g0"]
MSVC_FLAGS = ["/O2"]

# Docstrings stay on the functions, where doctest finds them; a second copy in __test__ would run them twice.
DIRECTIVES = {"language_level": 3, "autotestdict": False}

# Python 3.11 is the first whose stable interface has the buffers that typed arrays come by.
ABI3 = {"define_macros": [("Py_LIMITED_API", "0x030B0000")], "py_limited_api": True}
ABI3_TAG = "cp311"

NOT_ON_WINDOWS = ["shapeblend_cli/system/watchdog.py"]


def is_asked(name):
    """Return whether a variable of the environment says yes."""
    return os.environ.get(name, "0") not in ("", "0")


def is_abi3():
    """Return whether one binary is to serve Python 3.11 and all that follow. Free-threaded ones have no such thing."""
    return is_asked("SHAPEBLEND_ABI3") and not sysconfig.get_config_var("Py_GIL_DISABLED")


class BuildKernels(build_ext):
    """Translate the kernels, then compile them."""

    def build_extensions(self):
        # Here and not at the top: asking for metadata, or for an sdist, should not wait for Cython.
        from Cython.Build import cythonize

        for extension in self.extensions:
            translated = cythonize(
                [Extension(extension.name, extension.sources)],
                build_dir="build/cython",
                compiler_directives=DIRECTIVES,
                quiet=True,
            )
            extension.sources = translated[0].sources
            extension.extra_compile_args = MSVC_FLAGS if self.compiler.compiler_type == "msvc" else UNIX_FLAGS
        super().build_extensions()

    def build_extension(self, ext):
        # For an optional extension a failed compile is only a warning. It must not leave an older binary
        # behind, which Python would import in place of the newer source.
        binary = Path(self.get_ext_fullpath(ext.name))
        if newer_group([*ext.sources, *ext.depends], str(binary)):
            binary.unlink(missing_ok=True)
        super().build_extension(ext)


def kernels():
    """List the extensions; none if SHAPEBLEND_PURE asks for a package of plain Python."""
    if is_asked("SHAPEBLEND_PURE"):
        return []
    table = tomllib.loads(Path(__file__).with_name("pyproject.toml").read_text(encoding="utf-8"))
    # optional: without a C compiler the install goes on, and the same files run as Python, slower. But a wheel for
    # everybody must have its binaries.
    more = ABI3 if is_abi3() else {}
    return [
        Extension(
            path.removesuffix(".py").replace("/", "."),
            [path],
            depends=["setup.py"],
            optional=not more,
            **more,
        )
        for path in table["tool"]["shapeblend"]["kernels"]
        if os.name != "nt" or path not in NOT_ON_WINDOWS
    ]


extensions = kernels()
tag = {"py_limited_api": ABI3_TAG} if extensions and is_abi3() else {}

setup(
    ext_modules=extensions,
    cmdclass={"build_ext": BuildKernels},
    # As many are compiled at once as there are processors.
    options={"build_ext": {"parallel": True}, "bdist_wheel": tag},
)
