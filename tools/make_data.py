#!/usr/bin/env python3
"""Volumes that the repository does not carry, from the Debian package invesalius-examples: a head CT and its skull.

usage: make_data.py PACKAGE.deb FOLDER

cranium_ct.nrrd      256 x 256 x 108 int16 in Hounsfield units, as it is
cranium_skull.nrrd   the same where the package's bone mask, grown by two voxels, is set; -1024 (air) elsewhere
"""
import pathlib
import subprocess
import sys
import tarfile
import tempfile

SIZE = (256, 256, 108)
SPACING = (0.957031, 0.957031, 1.5)
AIR = -1024
GROWTH = 2


def header():
    directions = " ".join("(%s)" % ",".join(str(SPACING[a]) if a == b else "0" for b in range(3)) for a in range(3))
    return ("NRRD0004\ntype: int16\ndimension: 3\nspace: left-posterior-superior\nsizes: %d %d %d\n"
            "space directions: %s\nkinds: domain domain domain\nendian: little\nencoding: raw\n"
            "space origin: (0,0,0)\n\n" % (*SIZE, directions)).encode()


def members(package):
    """matrix.dat and mask_0.dat (bone: 226 to 3071 HU) of the package's project file."""
    with tempfile.TemporaryDirectory() as folder:
        subprocess.run(["dpkg-deb", "--extract", package, folder], check=True)
        project = next(pathlib.Path(folder).rglob("Cranium.inv3"))
        with tarfile.open(project) as tar:
            return [tar.extractfile(next(m for m in tar if m.name.endswith(name))).read()
                    for name in ("matrix.dat", "mask_0.dat")]


def mask_of(raw):
    """One byte per voxel, 0 or 1. The file has one more plane in front of each axis, which holds flags."""
    nx, ny, nz = SIZE
    out = bytearray()
    for z in range(nz):
        for y in range(ny):
            row = ((z + 1) * (ny + 1) + y + 1) * (nx + 1) + 1
            out += bytes(1 if b > 127 else 0 for b in raw[row:row + nx])
    return out


def grown(mask):
    """Set where a neighbour along an axis is set, too. A whole number with 8 bits per voxel does all at once."""
    bits = int.from_bytes(mask, "little")
    result = bits
    for stride in (1, SIZE[0], SIZE[0] * SIZE[1]):
        result |= bits << 8 * stride | bits >> 8 * stride
    return bytearray((result & ((1 << 8 * len(mask)) - 1)).to_bytes(len(mask), "little"))


def main(package, folder):
    matrix, mask = members(package)
    assert len(matrix) == 2 * SIZE[0] * SIZE[1] * SIZE[2], "matrix.dat has another size"
    folder = pathlib.Path(folder)
    folder.mkdir(parents=True, exist_ok=True)
    (folder / "cranium_ct.nrrd").write_bytes(header() + matrix)
    keep = mask_of(mask)
    for _ in range(GROWTH):
        keep = grown(keep)
    air = AIR.to_bytes(2, "little", signed=True)
    skull = bytearray(matrix)
    for i, inside in enumerate(keep):
        if not inside:
            skull[2 * i:2 * i + 2] = air
    (folder / "cranium_skull.nrrd").write_bytes(header() + skull)


if __name__ == "__main__":
    if len(sys.argv) != 3:
        sys.exit(__doc__)
    main(*sys.argv[1:])
