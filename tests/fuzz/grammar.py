#!/usr/bin/env python3
"""Files damaged in the grammar of their own format: what bytes changed at random hardly ever make.

  grammar.py SEEDS FOLDER COUNT [SEED]

Takes the files of the folder SEEDS and writes COUNT damaged ones to FOLDER, one to three damages each: words and lines
of text, values of JSON, elements and attributes of XML, numbers in binary files, entries of archives and what the
archive says of them. The same SEED gives the same files. scripts/fuzz --grammar reads them.
"""
import io
import json
import random
import re
import struct
import sys
import warnings
import zipfile
import zlib
from pathlib import Path

WORDS = ["0", "-1", "1", "2", "3", "255", "256", "65535", "65536", "2147483647", "2147483648", "4294967295", "4294967296",
         "9223372036854775807", "18446744073709551615", "18446744073709551616", "-9223372036854775809", "1e400", "-1e400",
         "1e-400", "nan", "-nan", "inf", "NaN(7)", "0x1p3", "1e", "1,5", "--1", "+-2", ".", "-", "9" * 60, "0." + "3" * 60,
         "1_000", "\0", "\xff", "\ufeff", "#", "//", '"', "'", "{", "<", "a" * 300]
KEYWORDS = ["OFF", "COFF", "NOFF", "4OFF", "STOFF", "BINARY", "v", "vn", "vt", "f", "l", "o", "usemtl", "ply", "format", "ascii",
            "binary_little_endian", "binary_big_endian", "element", "vertex", "face", "tristrips", "property", "list", "uchar",
            "int", "float", "double", "vertex_indices", "x", "y", "z", "nx", "end_header", "comment", "solid", "facet", "normal",
            "outer", "loop", "endloop", "endfacet", "endsolid", "VERSION", "FIELDS", "SIZE", "TYPE", "COUNT", "WIDTH", "HEIGHT",
            "VIEWPOINT", "POINTS", "DATA", "binary", "binary_compressed", "F", "U", "I", "PSB", "1", "path", "category", "split",
            "class", "fx", "K", "%YAML"]  # fmt: skip
NUMBERS = [0, -1, 1, 2, 3, 255, 65535, 65536, 2**31 - 1, 2**31, 2**32 - 1, 2**32, 2**53, 2**63, 2**64, -(2**31), 0.5, 1e39,
           1e308, -1e-320]  # fmt: skip
VALUES = NUMBERS + [None, True, False, "", "x" * 400, "../../etc/passwd", "data:;base64,AAAA", "%00", [], {}, [0], [[]], {"a": 1}]


def damage_words(text, rng):
    """Text as lines of words."""
    lines = [re.split(r"([ \t,;]+)", line) for line in text.split("\n")]
    at = rng.randrange(len(lines))
    line = lines[at]
    word = 2 * rng.randrange((len(line) + 1) // 2)
    kind = rng.randrange(11)
    if kind <= 2:
        line[word] = rng.choice(WORDS)
    elif kind == 3:
        line[word] = rng.choice(KEYWORDS)
    elif kind == 4:
        del line[word:word + 2]
    elif kind == 5:
        line[word:word] = [rng.choice(WORDS + KEYWORDS), " "]
    elif kind == 6:
        del lines[at]
    elif kind == 7:
        lines[at:at] = [list(line)] * rng.choice([1, 2, 50])
    elif kind == 8:
        other = rng.randrange(len(lines))
        lines[at], lines[other] = lines[other], lines[at]
    elif kind == 9:
        numbers = [i for i in range(0, len(line), 2) if re.fullmatch(r"\d+", line[i])]
        if numbers:
            k = rng.choice(numbers)
            line[k] = str(max(0, int(line[k]) + rng.choice([-2, -1, 1, 2, 1000])))
    else:
        return "\n".join("".join(each) for each in lines[:at]) + rng.choice(["", "\r", "\n\n", "\0", "\t"])
    return "\n".join("".join(each) for each in lines)


def places(value, path=()):
    """The ways to all values within one of JSON."""
    inner = value.items() if isinstance(value, dict) else enumerate(value) if isinstance(value, list) else ()
    for key, each in inner:
        yield path + (key,)
        yield from places(each, path + (key,))


def damage_json(document, rng):
    ways = list(places(document))
    if not ways:
        return rng.choice(VALUES)
    way = rng.choice(ways)
    holder = document
    for key in way[:-1]:
        holder = holder[key]
    key = way[-1]
    kind = rng.randrange(8)
    if kind <= 2:
        holder[key] = rng.choice(VALUES)
    elif kind == 3 and isinstance(holder[key], (int, float)):
        holder[key] += rng.choice([-1, 1, 4, 1000])
    elif kind == 4:
        del holder[key]
    elif kind == 5 and isinstance(holder, list):
        holder.extend([holder[key]] * rng.choice([1, 2, 100]))
    elif kind == 6:
        other = document
        for step in rng.choice(ways):
            other = other[step]
        holder[key] = json.loads(json.dumps(other))
    else:
        deep = rng.choice(VALUES)
        for _ in range(rng.choice([3, 200, 3000])):
            deep = [deep]
        holder[key] = deep
    return document


def damage_json_text(text, rng):
    try:
        document = json.loads(text)
    except ValueError:
        return damage_words(text, rng)
    try:
        return json.dumps(damage_json(document, rng))
    except RecursionError:
        return text[:rng.randrange(len(text))]


def damage_xml(text, rng):
    parts = re.split(r"(<[^>]*>)", text)
    tags = [i for i in range(len(parts)) if parts[i].startswith("<")]
    if not tags:
        return damage_words(text, rng)
    at = rng.choice(tags)
    kind = rng.randrange(7)
    if kind <= 2:
        attributes = list(re.finditer(r'"([^"]*)"', parts[at]))
        if attributes:
            where = rng.choice(attributes)
            parts[at] = parts[at][:where.start()] + '"' + rng.choice(WORDS) + '"' + parts[at][where.end():]
    elif kind == 3:
        del parts[at]
    elif kind == 4:
        parts[at:at] = [parts[at]] * rng.choice([1, 3, 2000])
    elif kind == 5:
        other = rng.choice(tags)
        parts[at], parts[other] = parts[other], parts[at]
    else:
        parts[at] = re.sub(r' [\w:]+="[^"]*"', "", parts[at], count=1)
    return "".join(parts)


def damage_numbers(data, rng):
    """Bytes as whole numbers and floats of 1 to 8 bytes that begin anywhere, but in front more often than behind."""
    if not data:
        return bytes(rng.randrange(256) for _ in range(rng.randrange(40)))
    at = rng.randrange(len(data)) if rng.random() < 0.5 else rng.randrange(min(len(data), 400))
    kind = rng.randrange(7)
    if kind <= 3:
        form = rng.choice(["<B", "<H", "<I", "<Q", ">H", ">I", ">Q", "<f", "<d", ">f"])
        if form[1] in "fd":
            new = struct.pack(form, rng.choice([0.0, float("nan"), float("inf"), -1e38, 3e38, 1e-42, 1.0]))
        else:
            new = struct.pack(form, int(rng.choice(NUMBERS)) % 256 ** struct.calcsize(form))
        return data[:at] + new + data[at + len(new):]
    if kind == 4:
        return data[:at]
    if kind == 5:
        size = rng.choice([1, 4, 12, 50])
        return data[:at] + data[at:at + size] * rng.choice([2, 3, 300]) + data[at + size:]
    return data[:at] + data[at + rng.choice([1, 4, 12, 50]):]


def damage_archive(data, rng):
    """An entry, what is said of it, or the archive's own records."""
    if rng.random() < 0.3:
        return damage_numbers(data, rng)
    entries = [[info.filename, packed.read(info)] for packed in [zipfile.ZipFile(io.BytesIO(data))] for info in packed.infolist()]
    at = rng.randrange(len(entries))
    kind = rng.randrange(6)
    if kind <= 2:
        entries[at][1] = damage_bytes(entries[at][1], rng)
    elif kind == 3:
        entries[at][0] = rng.choice([".", "../up", "a" * 200, entries[at][0].upper(), "3D/3dmodel.model", "points.npy"])
    elif kind == 4:
        entries += [entries[at]] * rng.choice([1, 30])
    else:
        del entries[at]
    out = io.BytesIO()
    with zipfile.ZipFile(out, "w", rng.choice([zipfile.ZIP_STORED, zipfile.ZIP_DEFLATED])) as packed:
        for name, content in entries:
            packed.writestr(name, content)
    return out.getvalue()


def damage_glb(data, rng):
    """The JSON within, its chunk's length right again or not."""
    length = struct.unpack_from("<I", data, 12)[0]
    text = damage_json_text(data[20:20 + length].decode("utf-8", "replace"), rng).encode("utf-8", "replace")
    text += b" " * (-len(text) % 4)
    rest = data[20 + length:]
    total = 20 + len(text) + len(rest)
    said = total if rng.random() < 0.8 else rng.choice([0, total + 4, 2**32 - 1])
    return data[:8] + struct.pack("<I", said) + struct.pack("<I", len(text)) + data[16:20] + text + rest


def damage_head(data, rng):
    """Text in front of binary rows (PLY, PCD, binary OFF, NPY): one of the two."""
    marks = [b"end_header\n", b"DATA binary\n", b"DATA binary_compressed\n", b"BINARY\n", b"}"]
    ends = [data.find(mark) + len(mark) for mark in marks if mark in data]
    end = min(ends, default=len(data))
    if rng.random() < 0.4:
        return data[:end] + damage_numbers(data[end:], rng)
    return damage_words(data[:end].decode("latin-1"), rng).encode("latin-1", "replace") + data[end:]


def damage_bytes(data, rng):
    """By what the content looks like."""
    try:
        if data.startswith(b"PK"):
            return damage_archive(data, rng)
        if data.startswith(b"glTF") and len(data) > 20 and rng.random() < 0.8:
            return damage_glb(data, rng)
    except (ValueError, struct.error, zipfile.BadZipFile, zlib.error, NotImplementedError, EOFError, OverflowError, RuntimeError):
        return damage_numbers(data, rng)  # an archive or a chunk that is damaged already
    begin = data.lstrip()[:1]
    if begin == b"{":
        return damage_json_text(data.decode("utf-8", "replace"), rng).encode("utf-8", "replace")
    if begin == b"<":
        return damage_xml(data.decode("utf-8", "replace"), rng).encode("utf-8", "replace")
    if b"\0" in data[:200] or data[:1] > b"\x7f":
        return damage_numbers(data, rng) if rng.random() < 0.5 else damage_head(data, rng)
    return damage_head(data, rng)


def main(seeds, folder, count, seed="1"):
    warnings.simplefilter("ignore")  # names that an archive has twice are meant
    rng = random.Random(int(seed))
    files = sorted(Path(seeds).iterdir())
    out = Path(folder)
    out.mkdir(parents=True, exist_ok=True)
    for k in range(int(count)):
        data = rng.choice(files).read_bytes()
        for _ in range(rng.choice([1, 1, 2, 3])):
            data = damage_bytes(data, rng)
        (out / f"{k:06}").write_bytes(data)


if __name__ == "__main__":
    if len(sys.argv) not in (4, 5):
        sys.exit(__doc__)
    main(*sys.argv[1:])
