"""Counts of answers that differ, on files whose differences are known."""
import math
import struct
import sys
import tempfile
import unittest
from pathlib import Path

sys.dont_write_bytecode = True
sys.path.insert(0, str(Path(__file__).resolve().parents[2] / 'tools'))
from hit_differences import HitFiles, differences, read_npy  # noqa: E402

RADIUS = 1e-3


def write_npy(path, kind, shape, values):
    header = str({'descr': {'f': '<f4', 'i': '<i4'}[kind], 'fortran_order': False, 'shape': shape}).encode() + b'\n'
    path.write_bytes(b'\x93NUMPY\x01\x00' + struct.pack('<H', len(header)) + header +
                     struct.pack(f'<{len(values)}{kind}', *values))


class HitDifferences(unittest.TestCase):
    def setUp(self):
        scratch = tempfile.TemporaryDirectory()
        self.addCleanup(scratch.cleanup)
        self.folder = Path(scratch.name)
        # Three curves: two on the first strand, one on the second. A radius of 0 is not the thinnest.
        radii = [0, 2 * RADIUS, RADIUS, RADIUS]
        points = [value for curve in range(3) for radius in radii for value in (curve, 0, 0, radius)]
        write_npy(self.folder / 'curves.npy', 'f', (3, 4, 4), points)
        write_npy(self.folder / 'strands.npy', 'i', (2, 2), [0, 2, 2, 1])

    def hits(self, name, answers):
        """Answers are (t, u, curve)."""
        folder = self.folder / name
        folder.mkdir()
        for i, (file, kind) in enumerate((('t', 'f'), ('u', 'f'), ('curve', 'i'))):
            write_npy(folder / f'{file}.npy', kind, (len(answers),), [answer[i] for answer in answers])
        return HitFiles(folder)

    def count(self, a, b):
        return differences(self.hits('a', a), self.hits('b', b), self.folder / 'curves.npy', self.folder / 'strands.npy')

    def test_each_kind_is_counted_once(self):
        miss = (math.inf, 0, -1)
        pairs = [(miss, miss), ((1, 0.5, 0), (1, 0.5, 0)),              # the same
                 (miss, (1, 0, 0)), ((1, 0, 2), miss),                  # hit or miss
                 ((1, 0, 1), (1, 0, 2)),                                # another strand
                 ((1, 0, 1), (1 + 0.02 * RADIUS, 0, 1)),                # the distance
                 ((1, 0, 1), (math.nan, 0, 1)),                         # not a number is a difference
                 ((1, 1, 0), (1, 0, 1)), ((1, 0.5, 0), (1, 0.25, 0)),   # bits alone: another curve of the strand; u
                 ((1, 0, 1), (1 + 0.005 * RADIUS, 0, 1)),               # and rounding of t
                 ((100, 0, 1), (100 + 0.05 * RADIUS, 0, 1))]            # far away too
        self.assertEqual(self.count(*zip(*pairs)), (2, 1, 2, 9))

    def test_no_rays(self):
        self.assertEqual(self.count([], []), (0, 0, 0, 0))

    def test_files_that_are_no_hits(self):
        path = self.folder / 'x.npy'
        path.write_bytes(b'no such thing')
        self.assertRaisesRegex(ValueError, 'x.npy: not a NumPy file', read_npy, path, 'f')
        write_npy(path, 'i', (1,), [1])
        self.assertRaisesRegex(ValueError, 'x.npy: items are <i4', read_npy, path, 'f')
        write_npy(path, 'f', (2,), [1])
        self.assertRaisesRegex(ValueError, 'x.npy: 1 items', read_npy, path, 'f')


unittest.main()
