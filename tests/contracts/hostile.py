"""Small files that promise, or unpack to, more than there is: each by the name under which it is read."""

import io
import struct
import zipfile
import zlib
from pathlib import Path

import numpy as np

HUGE = 10**12


def npy_head(shape: tuple[int, ...], kind: str = "<f8") -> bytes:
    """The head of a NumPy array of such a shape, without values."""
    stream = io.BytesIO()
    np.lib.format.write_array_header_1_0(stream, {"descr": kind, "fortran_order": False, "shape": shape})
    return stream.getvalue()


def zipped(path: Path, **members: bytes) -> None:
    with zipfile.ZipFile(path, "w", zipfile.ZIP_DEFLATED) as archive:
        for name, data in members.items():
            archive.writestr(f"{name}.npy", data)


def bomb_npz(path: Path) -> None:
    """640 MB of zeros in 3 MB."""
    archive = zipfile.ZipFile(path, "w", zipfile.ZIP_DEFLATED, compresslevel=1)
    with archive, archive.open("K.npy", "w", force_zip64=True) as stream:
        stream.write(npy_head((80_000_000,)))
        for _ in range(80):
            stream.write(bytes(8_000_000))


def mat5(*elements: bytes) -> bytes:
    """A MATLAB 5 file, little-endian."""
    return b"MATLAB 5.0 MAT-file".ljust(124) + b"\x00\x01IM" + b"".join(elements)


def element(kind: int, data: bytes) -> bytes:
    """A data element, padded to 8 bytes."""
    return struct.pack("<II", kind, len(data)) + data + bytes(-len(data) % 8)


def array(kind: int, shape: tuple[int, ...], *parts: bytes) -> bytes:
    """An array of the class `kind`, called K."""
    head = element(6, struct.pack("<II", kind, 0)) + element(5, np.array(shape, "<i4").tobytes()) + element(1, b"K")
    return element(14, head + b"".join(parts))


def compressed(data: bytes) -> bytes:
    packed = zlib.compress(data, 9)
    return struct.pack("<II", 15, len(packed)) + packed


def bomb_mat(path: Path) -> None:
    """An element that unpacks to 256 MB of zeros, of 1 MB."""
    machine = zlib.compressobj(1)
    size = 256_000_000
    inner = struct.pack("<II", 14, size) + array(6, (1, 1))[8:]
    packed = (
        machine.compress(inner) + b"".join(machine.compress(bytes(16_000_000)) for _ in range(16)) + machine.flush()
    )
    path.write_bytes(mat5(struct.pack("<II", 15, len(packed)) + packed))


def nested_cells(path: Path, depth: int = 20_000) -> None:
    data = array(6, (1, 1), element(9, bytes(8)))
    for _ in range(depth):
        data = element(14, array(1, (1, 1))[8:] + data)
    path.write_bytes(mat5(data))


def wav(path: Path, samples: int, riff: bytes = b"RIFF", channels: int = 1) -> None:
    """A head that promises so many bytes of samples, and 8 of them."""
    fmt = struct.pack("<HHIIHH", 1, channels, 8000, 16000, 2, 16)
    sizes = b"ds64" + struct.pack("<IQQQI", 28, samples + 100, samples, samples // 2, 0) if riff == b"RF64" else b""
    data = b"data" + struct.pack("<I", min(samples, 2**32 - 1)) + bytes(8)
    path.write_bytes(
        riff + struct.pack("<I", 2**32 - 1) + b"WAVE" + sizes + b"fmt " + struct.pack("<I", 16) + fmt + data
    )


def universal(count: int, binary: bool, lines: int = 3) -> bytes:
    """A data set 58 that promises `count` values."""
    place = f" {'NONE':<10}{1:10d}{1:4d}"
    axis = f"{17:10d}{0:5d}{0:5d}{0:5d} {'NONE':<20} {'NONE':<20}"
    head = ["", "NONE", "NONE", "NONE", "NONE", f"{1:5d}{0:10d}{1:5d}{0:10d}{place}{place}"]
    head += [f"{2:10d}{count:10d}{1:10d}{0:13.5e}{1:13.5e}{0:13.5e}", *[axis] * 4]
    first = f"    58b     1     2          11{4 * count:12d}" if binary else "    58"
    body = bytes(12) if binary else b"  1.0\n" * lines
    return ("    -1\n" + first + "\n" + "\n".join(head) + "\n").encode() + body + b"\n    -1\n"


def text(word: str) -> bytes:
    """A text as TDMS writes it."""
    return struct.pack("<I", len(word)) + word.encode()


def tdms(path: Path, count: int, scales: int = 0) -> None:
    """A channel that promises `count` values of 8 bytes, and has two."""
    stated = text("NI_Number_Of_Scales") + struct.pack("<II", 7, scales) if scales else b""
    index = struct.pack("<IIIQ", 20, 10, 1, count)
    meta = struct.pack("<I", 1) + text("/'run'/'x'") + index + struct.pack("<I", bool(scales)) + stated
    path.write_bytes(b"TDSm" + struct.pack("<IIQQ", 0x0E, 4713, len(meta) + 8 * count, len(meta)) + meta + bytes(16))


def fragments(path: Path, channels: int = 2000, segments: int = 20_000) -> None:
    """Few values in very many segments, each of all channels."""
    index = struct.pack("<IIIQ", 20, 10, 1, 1) + struct.pack("<I", 0)
    meta = struct.pack("<I", channels) + b"".join(text(f"/'r'/'{i}'") + index for i in range(channels))
    head = struct.pack("<IIQQ", 0x0E, 4713, len(meta) + 8 * channels, len(meta))
    more = b"TDSm" + struct.pack("<IIQQ", 0x0A, 4713, 4, 4) + bytes(4)
    path.write_bytes(b"TDSm" + head + meta + bytes(8 * channels) + more * segments)


def hdf5(path: Path, how: str) -> None:
    """A data set that unpacks to more than there is, or lies elsewhere."""
    import h5py

    with h5py.File(path, "w") as file:
        if how == "zeros":
            file.create_dataset("K", (30_000, 30_000), "f8", chunks=(1000, 1000), compression="gzip")
        elif how == "chunk":
            file.create_dataset("K", (2, 2), "f8", chunks=(20_000, 20_000), maxshape=(None, None), compression="gzip")
        elif how == "texts":
            file.create_dataset("K", (9000,), "S300000", chunks=(10,), compression="gzip")
        elif how == "link":
            file["K"] = h5py.ExternalLink("secret.h5", "/K")
        elif how == "link by link":
            file["far"] = h5py.ExternalLink("secret.h5", "/")
            file["K"] = h5py.SoftLink("/far/K")
        elif how == "virtual":
            layout = h5py.VirtualLayout((2, 2), "f8")
            layout[:] = h5py.VirtualSource("secret.h5", "K", (2, 2))
            file.create_virtual_dataset("K", layout)
        elif how == "external":
            file.create_dataset("K", (2, 2), "f8", external=[("secret.bin", 0, 32)])
        elif how == "deep":
            group = file
            for _ in range(3000):
                group = group.create_group("g")
        elif how == "loop":
            group = file.create_group("g")
            for i in range(30):
                group[f"{i}"] = group


def matlab4(path: Path) -> None:
    path.write_bytes(struct.pack("<IIIII", 0, 100_000, 100_000, 0, 2) + b"K\0" + bytes(64))


MARKET = "%%MatrixMarket matrix {} real symmetric\n{}\n1 1 1.0\n"
TITLE = "title".ljust(72) + "key\n"
HB = (
    TITLE
    + "{0:14d}{1:14d}{2:14d}{3:14d}{4:14d}\n"
    + "RSA".ljust(14)
    + "{5:14d}{5:14d}{6:14d}{4:14d}\n"
    + "{7:<16}{7:<16}{8:<20}\n"
    + "1\n" * 9
)
OP4 = "{:8d}{:8d}{:8d}{:8d}K       1P,5E16.9\n       1       1{:8d}\n 1.000000000E+00\n       4       1       1\n 1.0\n"

MATRICES = {
    "order.mtx": MARKET.format("coordinate", "1000000000 1000000000 1000000000000"),
    "entries.mtx": MARKET.format("coordinate", "1000 1000 1000000000000"),
    "dense.mtx": MARKET.format("array", "900000 900000"),
    "order.hb": HB.format(9, 1, 1, 1, 0, 10**9, 10**9, "(5I8)", "(5E16.8)"),
    "entries.hb": HB.format(9, 1, 4, 4, 0, 3, 10**12, "(5I8)", "(5E16.8)"),
    "fields.hb": HB.format(9, 1, 4, 4, 0, 3, 900_000_000, "(999999999I1)", "(999999999E1.0)"),
    "cards.hb": HB.format(10**13, 10**12, 10**12, 10**12, 0, 3, 3, "(5I8)", "(5E16.8)"),
    "order.op4": OP4.format(10**7, 10**7, 6, 2, 1),
    "words.op4": OP4.format(3, 3, 6, 2, 9999999),
    "names.op4": OP4.format(3, 3, 6, 2, 1) * 10_000,
    "binary.op4": b"".join(struct.pack("<I", n) for n in (24, 3, 3, 6, 2)) + b"K       " + struct.pack("<II", 24, 2**32 - 100),
    "zeros.npz": bomb_npz,
    "shape.npz": lambda path: zipped(path, K=npy_head((HUGE, HUGE)) + bytes(8)),
    "objects.npz": lambda path: zipped(path, K=npy_head((2, 2), "|O") + b"cos\nsystem\n(S'touch pwned'\ntR."),
    "struct.mat": bomb_mat,
    "cells.mat": nested_cells,
    "text.mat": mat5(array(4, (60_000, 60_000), element(4, b""))),
    "cell.mat": mat5(array(1, (60_000, 60_000))),
    "type.mat": mat5(compressed(array(6, (1, 1), element(77, bytes(8))))),
    "flat.mat": mat5(array(4, (), element(4, b"a"))),
    "four.mat": matlab4,
    "zeros.h5": lambda path: hdf5(path, "zeros"),
    "chunk.h5": lambda path: hdf5(path, "chunk"),
    "link.h5": lambda path: hdf5(path, "link"),
    "virtual.h5": lambda path: hdf5(path, "virtual"),
    "external.h5": lambda path: hdf5(path, "external"),
    "wide.csv": "1," * 3_000_000 + "1\n",
    "cell.csv": "1" * 5_000_000 + "\n",
    "index.csv": "i,j,value\n1000000000,1000000000,1\n",
    "index.sti": "1000000000 1000000000 1.0\n",
    "digits.sti": f"{'9' * 5000} 1 1.0\n",
}  # fmt: skip
RECORDINGS = {
    "zeros.npz": bomb_npz,
    "shape.npz": lambda path: zipped(path, x=npy_head((HUGE,)) + bytes(8)),
    "objects.npz": lambda path: zipped(path, x=npy_head((2,), "|O") + b"cos\nsystem\n(S'touch pwned'\ntR."),
    "shape.npy": npy_head((HUGE,)) + bytes(8),
    "pickle.npy": b"cos\nsystem\n(S'touch pwned'\ntR.",
    "struct.mat": bomb_mat,
    "cells.mat": nested_cells,
    "text.mat": mat5(array(4, (60_000, 60_000), element(4, b""))),
    "flat.mat": mat5(array(4, (), element(4, b"a"))),
    "four.mat": matlab4,
    "zeros.h5": lambda path: hdf5(path, "zeros"),
    "chunk.h5": lambda path: hdf5(path, "chunk"),
    "texts.h5": lambda path: hdf5(path, "texts"),
    "link.h5": lambda path: hdf5(path, "link"),
    "virtual.h5": lambda path: hdf5(path, "virtual"),
    "external.h5": lambda path: hdf5(path, "external"),
    "deep.h5": lambda path: hdf5(path, "deep"),
    "loop.h5": lambda path: hdf5(path, "loop"),
    "long.wav": lambda path: wav(path, 2**32 - 2),
    "longer.wav": lambda path: wav(path, 2**60, b"RF64"),
    "channels.wav": lambda path: wav(path, 8, channels=65535),
    "text.unv": universal(400_000_000, False),
    "binary.unv": universal(400_000_000, True),
    "marks.unv": "    -1\n    15\n" * 150_000,
    "functions.unv": "    -1\n    58\n" * 150_000,
    "values.tdms": lambda path: tdms(path, 10**11),
    "scales.tdms": lambda path: tdms(path, 2, 2**32 - 1),
    "fragments.tdms": fragments,
    "units.csv": "[" * 100_000 + "(" * 100_000 + "\n1\n2\n",
    "wide.csv": "1," * 3_000_000 + "1\n",
    "cell.csv": "1" * 5_000_000 + "\n",
    "quotes.csv": "t,x\n" + '"' * 3_000_000 + "\n",
}  # fmt: skip
_HEAD = "mouse: 1\nmodel: "
_NODES = "{structure: {nodes: {1: [0, 0]}, "
_SPRING = "{stiffness: {diagonal: [1]}, mass: {identity: 1}}\n"
_ALIASES = "".join(f"a{i}: &a{i} [{', '.join([f'*a{i - 1}'] * 10)}]\n" for i in range(1, 12))
DECKS = {
    "aliases.yaml": "mouse: 1\na0: &a0 [1, 1, 1]\n" + _ALIASES + "model: *a11\n",
    "chain.yaml": "mouse: 1\na0: &a0 [1]\n" + "".join(f"a{i}: &a{i} [*a{i - 1}]\n" for i in range(1, 5000))
    + "model: *a4999\n",
    "deep.yaml": "mouse: 1\na0: &a0 [1]\n" + "".join(f"a{i}: &a{i} [*a{i - 1}]\n" for i in range(1, 900)) + "model: *a899\n",
    "itself.yaml": "mouse: 1\nmodel: &m {stiffness: *m, mass: *m}\n",
    "nested.yaml": _HEAD + "[" * 100_000,
    "integer.yaml": _HEAD + "{stiffness: {order: " + "9" * 10_000 + ", entries: []}, mass: {identity: 1}}\n",
    "order.yaml": _HEAD + "{stiffness: {order: 1000000000, entries: [[1, 1, 1]]}, mass: {identity: 1000000000}}\n",
    "range.yaml": _HEAD + _NODES + "elements: [{type: mass, nodes: 1-1000000000, mass: 1}]}}\n",
    "ranges.yaml": _HEAD + _NODES + "elements: [{type: mass, nodes: '" + "1-4000000," * 1000 + "1', mass: 1}]}}\n",
    "digits.yaml": _HEAD + _NODES + "elements: [{type: mass, nodes: 1-" + "9" * 900 + ", mass: 1}]}}\n",
    "line.yaml": _HEAD + "{structure: {nodes: {line: {from: 1, to: 2000000000, start: [0, 0], end: [1, 0]}}, "
    + "elements: [{type: mass, nodes: 1, mass: 1}]}}\n",
    "step.yaml": "mouse: 1\ncouple: {substructures: {a: {deck: chain.yaml}}, lines: {band: [0, 1e9], step: 1e-9}}\n",
    "scalar.yaml": _HEAD + "'" + "x" * 20_000_000 + "'\n",
    "tag.yaml": "mouse: 1\nmodel: !!python/object/apply:os.system ['touch pwned']\n",
    "tag2.yaml": "mouse: 1\ntitle: !!python/name:os.system x\nmodel: " + _SPRING + "prior: !!binary aGk=\n",
    "keys.yaml": "mouse: 1\n" + "".join(f"k{i}: 1\n" for i in range(200_000)),
    "cards.dat": "TITLE\n" + "9" * 80 + "\n" + ("  1  1    1.0000E+03\n" * 100_000),
}  # fmt: skip


def write(path: Path, content: object) -> None:
    """The file: by a text, by bytes, or by what writes it."""
    if callable(content):
        content(path)
    elif isinstance(content, bytes):
        path.write_bytes(content)
    else:
        path.write_text(content)
