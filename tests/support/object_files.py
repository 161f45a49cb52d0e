"""Small objects as files of every format, for tests that need many."""
import base64
import json
import math
import struct


def box(x, y, z):
    corners = [(x * (i & 1), y * (i >> 1 & 1), z * (i >> 2 & 1)) for i in range(8)]
    quads = [(0, 2, 3, 1), (4, 5, 7, 6), (0, 1, 5, 4), (2, 6, 7, 3), (0, 4, 6, 2), (1, 3, 7, 5)]
    return corners, [t for a, b, c, d in quads for t in ((a, b, c), (a, c, d))]


def lathe(radius, height, top, sides, rings):
    """A body of revolution around z, from `radius` below to `radius * top` above, with both ends closed."""
    points, faces = [(0.0, 0.0, 0.0), (0.0, 0.0, height)], []
    for ring in range(rings + 1):
        share = ring / rings
        r = radius * (1 - share + share * top)
        points += [(r * math.cos(2 * math.pi * k / sides), r * math.sin(2 * math.pi * k / sides), height * share)
                   for k in range(sides)]
    for k in range(sides):
        n = (k + 1) % sides
        faces.append((0, 2 + n, 2 + k))
        faces.append((1, 2 + rings * sides + k, 2 + rings * sides + n))
        for ring in range(rings):
            a, b = 2 + ring * sides, 2 + (ring + 1) * sides
            faces += [(a + k, a + n, b + n), (a + k, b + n, b + k)]
    return points, faces


def grown(mesh, factors):
    points, faces = mesh
    return [tuple(c * f for c, f in zip(p, factors)) for p in points], faces


def rows(values, lead=""):
    return "".join(lead + " ".join(f"{v:.6g}" for v in row) + "\n" for row in values)


def off(points, faces):
    return (f"OFF\n{len(points)} {len(faces)} 0\n" + rows(points) + rows(faces, "3 ")).encode()


def obj(points, faces):
    return (rows(points, "v ") + rows([[i + 1 for i in f] for f in faces], "f ")).encode()


def ply(points, faces):
    head = (f"ply\nformat binary_little_endian 1.0\nelement vertex {len(points)}\nproperty float x\nproperty float y\n"
            f"property float z\nelement face {len(faces)}\nproperty list uchar int vertex_indices\nend_header\n")
    return (head.encode() + b"".join(struct.pack("<3f", *p) for p in points) +
            b"".join(struct.pack("<B3i", 3, *f) for f in faces))


def stl(points, faces):
    body = b"".join(struct.pack("<12fH", 0, 0, 0, *(c for i in f for c in points[i]), 0) for f in faces)
    return b"\0" * 80 + struct.pack("<I", len(faces)) + body


def pcd(points, _):
    n = len(points)
    return (f"VERSION .7\nFIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nCOUNT 1 1 1\nWIDTH {n}\nHEIGHT 1\n"
            f"VIEWPOINT 0 0 0 1 0 0 0\nPOINTS {n}\nDATA ascii\n" + rows(points)).encode()


def xyz(points, _):
    return rows(points).encode()


def gltf_parts(points, faces):
    places = b"".join(struct.pack("<3f", *p) for p in points)
    indices = b"".join(struct.pack("<3I", *f) for f in faces)
    low = [min(p[a] for p in points) for a in range(3)]
    high = [max(p[a] for p in points) for a in range(3)]
    document = {
        "asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}],
        "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "indices": 1}]}],
        "accessors": [{"bufferView": 0, "componentType": 5126, "count": len(points), "type": "VEC3", "min": low,
                       "max": high},
                      {"bufferView": 1, "componentType": 5125, "count": 3 * len(faces), "type": "SCALAR"}],
        "bufferViews": [{"buffer": 0, "byteOffset": 0, "byteLength": len(places)},
                        {"buffer": 0, "byteOffset": len(places), "byteLength": len(indices)}],
        "buffers": [{"byteLength": len(places) + len(indices)}]}
    return document, places + indices


def gltf(points, faces):
    document, data = gltf_parts(points, faces)
    document["buffers"][0]["uri"] = "data:application/octet-stream;base64," + base64.b64encode(data).decode()
    return json.dumps(document).encode()


def glb(points, faces):
    document, data = gltf_parts(points, faces)
    text = json.dumps(document).encode()
    text += b" " * (-len(text) % 4)
    data += b"\0" * (-len(data) % 4)
    return (struct.pack("<4sII", b"glTF", 2, 28 + len(text) + len(data)) + struct.pack("<I4s", len(text), b"JSON") +
            text + struct.pack("<I4s", len(data), b"BIN\0") + data)


FORMATS = {"off": off, "obj": obj, "ply": ply, "stl": stl, "pcd": pcd, "xyz": xyz, "gltf": gltf, "glb": glb}


def write_data_set(folder, count):
    """Two categories of `count` objects each."""
    for k in range(count):
        for name, mesh in (("box", box(1 + 0.1 * k, 1, 1.2)), ("cone", lathe(0.5, 1 + 0.1 * k, 0.05, 16, 2))):
            (folder / name).mkdir(parents=True, exist_ok=True)
            (folder / name / f"{k}.off").write_bytes(off(*mesh))
