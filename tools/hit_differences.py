"""How the answers of two traces of the same rays differ; files as strandlab trace writes them."""
import ast
import math
from array import array
from collections import namedtuple

#: Rays with another answer: hit or miss, the strand, the distance by more than rounding; or any other bits.
Differences = namedtuple('Differences', 'hit strand distance bits')


def read_npy(path, kind):
    """The numbers of a NumPy file of little-endian 4-byte items ('f' or 'i'), row by row."""
    with open(path, 'rb') as file:
        magic = file.read(8)
        if magic[:6] != b'\x93NUMPY':
            raise ValueError(f'{path}: not a NumPy file')
        header = ast.literal_eval(file.read(int.from_bytes(file.read(2 if magic[6] == 1 else 4), 'little')).decode())
        if header['descr'] != {'f': '<f4', 'i': '<i4'}[kind] or header['fortran_order']:
            raise ValueError(f'{path}: items are {header["descr"]}')
        values = array(kind)
        values.frombytes(file.read())
    if len(values) != math.prod(header['shape']):
        raise ValueError(f'{path}: {len(values)} items, the header says {header["shape"]}')
    return values


class HitFiles:
    """Distance, place along the curve and curve of each ray; a miss has curve -1."""

    def __init__(self, folder):
        self.t, self.u = read_npy(folder / 't.npy', 'f'), read_npy(folder / 'u.npy', 'f')
        self.curve = read_npy(folder / 'curve.npy', 'i')


def strand_of_curves(path, count):
    strands, of = read_npy(path, 'i'), array('i', bytes(4 * count))
    for i in range(0, len(strands), 2):
        for curve in range(strands[i], strands[i] + strands[i + 1]):
            of[curve] = i // 2
    return of


def differences(a, b, curves, strands):
    """The rule of bench --ablation: distances are told apart by a hundredth of the thinnest radius, or 1e-6 of t."""
    points = read_npy(curves, 'f')
    thinnest = min((r for r in points[3::4] if r > 0), default=math.inf)
    strand = strand_of_curves(strands, len(points) // 16)
    hit = other_strand = distance = bits = 0
    for t, u, curve, t2, u2, curve2 in zip(a.t, a.u, a.curve, b.t, b.u, b.curve):
        if t == t2 and u == u2 and curve == curve2:
            continue
        bits += 1
        if (curve < 0) != (curve2 < 0):
            hit += 1
        elif curve >= 0 and strand[curve] != strand[curve2]:
            other_strand += 1
        elif curve >= 0 and not abs(t - t2) <= max(1e-2 * thinnest, 1e-6 * abs(t)):
            distance += 1
    return Differences(hit, other_strand, distance, bits)
