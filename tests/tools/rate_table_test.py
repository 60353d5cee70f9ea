"""tools/rate_table on result rows whose numbers are known, and on files that are none."""
import json
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]


def run(*arguments):
    return subprocess.run([sys.executable, ROOT / 'tools/rate_table', *arguments], capture_output=True, text=True)


def row(rays, speed, wrong):
    counts = {kind: {'count': 0} for kind in ('false_hit', 'false_miss', 'wrong_strand', 'wrong_place')}
    counts['wrong_strand'] = {'count': wrong}
    return {'model': {'spec': 'hair/curves.npy', 'curves': 100}, 'rays': {'name': rays},
            'primitive': {'label': 'prhi'}, 'settings': {'low_memory': False},
            'memory': {'bytes_per_curve': 142.0, 'peak_bytes': 49600},
            'time': {'mrays_per_second': speed, 'build_ms': 6.87},
            'model_error': {'decisive': {**counts, 'distance': {'p99': 0.0023}}}}


class RateTable(unittest.TestCase):
    def write(self, text):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        path = Path(folder.name) / 'rows.jsonl'
        path.write_text(text, encoding='utf-8')
        return path

    def test_a_line_for_each_primitive_with_all_ray_sets(self):
        rows = [row('hair/rays_primary.npy', 299.0, 2), row('hair/rays_bounce.npy shadow', 1114.0, 3)]
        result = run(self.write('\n'.join(json.dumps(r) for r in rows) + '\n'))
        self.assertEqual(result.returncode, 0, result.stderr)
        lines = result.stdout.splitlines()
        self.assertEqual(lines[0].split(), ['model', 'primitive', 'B/curve', 'peak', 'build', 'ms', 'primary', 'bounce',
                                            'shadow', 'wrong', 'dt', 'p99'])
        self.assertEqual(lines[2].split(), ['hair', 'prhi', '142', '496', '6.87', '299', '1114', '5', '0.0023', '/',
                                            '0.0023'])
        self.assertEqual(len(lines), 3)

    def test_files_that_are_none(self):
        for path, code in ((Path('/nowhere/rows.jsonl'), 3), (self.write('{"model": '), 3)):
            with self.subTest(path=path):
                result = run(path)
                self.assertEqual(result.returncode, code)
                self.assertEqual(len(result.stderr.splitlines()), 1, result.stderr)
                self.assertIn(str(path), result.stderr)
        self.assertEqual(run().returncode, 2)


if __name__ == '__main__':
    unittest.main()
