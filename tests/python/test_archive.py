"""What is inside an FMU file: names, libraries, symbols (FMI 2.0, sections 2.1.2 and 2.3; docs/guide/fmus.md)."""

import re
import zipfile

import fmpy.fmi2
import pytest
from elftools.elf.elffile import ELFFile
from spoil import DESCRIPTION

# FMPy binds every function of the standard, those of model exchange too.
FUNCTIONS = {name for kind in (fmpy.fmi2.FMU2Model, fmpy.fmi2.FMU2Slave) for name in dir(kind) if name.startswith("fmi2")}
# What any Linux machine with Rust programs has.
ALLOWED = {"libc.so.6", "libm.so.6", "libgcc_s.so.1", "ld-linux-x86-64.so.2"}


@pytest.fixture
def archive(any_fmu):
    with zipfile.ZipFile(any_fmu.path) as archive:
        yield archive


@pytest.fixture
def library(any_fmu):
    with open(any_fmu.folder / "binaries" / "linux64" / f"{any_fmu.identifier}.so", "rb") as file:
        yield ELFFile(file)


def test_all_members_are_where_the_standard_wants_them(any_fmu, archive):
    """FMI 2.0, section 2.3."""
    resource = {"TrainTrack": "train-track.json", "Bridge": "bridge.json"}[any_fmu.identifier]
    # The matrices of a bridge of finite elements.
    matrices = [name for name in archive.namelist() if name == "resources/bridge.bin"]
    names = archive.namelist()
    # A program that leaves the house has the libraries of several systems inside.
    others = [name for name in names if name == f"binaries/win64/{any_fmu.identifier}.dll"]
    assert names == [
        DESCRIPTION,
        f"binaries/linux64/{any_fmu.identifier}.so",
        *others,
        "documentation/index.html",
        "documentation/licenses/license.txt",
        *matrices,
        f"resources/{resource}",
    ]


def test_all_members_are_whole_and_stored_or_deflated(archive):
    """Importers know no other compression; testzip checks every CRC."""
    assert archive.testzip() is None
    assert {member.compress_type for member in archive.infolist()} <= {zipfile.ZIP_STORED, zipfile.ZIP_DEFLATED}


def test_no_member_name_has_a_dot_segment_or_a_backslash(archive):
    """docs/guide/fmus.md: "./" and backslashes are refused by some importers."""
    for member in archive.infolist():
        assert re.fullmatch(r"[\w.-]+(/[\w.-]+)*", member.orig_filename), member.orig_filename
        assert "." not in member.orig_filename.split("/")


def test_the_same_scenario_gives_the_same_file(ttb, examples, r1, tmp_path):
    """No time stamps, no order of directories."""
    ttb("build", examples / "r1.json", "-o", tmp_path)
    for fmu in (r1.train_track, r1.bridge):
        assert (tmp_path / fmu.path.name).read_bytes() == fmu.path.read_bytes()


def test_the_documentation_names_every_variable(any_fmu, archive):
    """documentation/index.html is what a user opens first."""
    page = archive.read("documentation/index.html").decode()
    assert [name for name in any_fmu.variables if f"<code>{name}</code>" not in page] == []


def test_the_description_has_no_byte_order_mark(archive):
    """docs/guide/fmus.md: some readers stumble over it."""
    assert archive.read(DESCRIPTION).startswith(b"<?xml")


def test_the_library_exports_the_44_functions_and_nothing_else(library):
    """FMI 2.0: 44 functions; one importer binds them eagerly, and other symbols could clash."""
    symbols = library.get_section_by_name(".dynsym").iter_symbols()
    exported = {s.name for s in symbols if s.entry.st_shndx != "SHN_UNDEF" and s.entry.st_info.bind == "STB_GLOBAL"}
    assert len(FUNCTIONS) == 44
    assert exported == FUNCTIONS


def test_the_library_needs_nothing_but_the_c_library(library):
    """docs/guide/fmus.md: libc, libm, libgcc_s."""
    needed = {tag.needed for tag in library.get_section_by_name(".dynamic").iter_tags("DT_NEEDED")}
    assert needed <= ALLOWED
