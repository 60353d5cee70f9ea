"""What tools/compare_versions says to arguments that are wrong: one line, and the exit code of usage errors."""
import os
import subprocess
import sys
import unittest
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]


def run(*arguments, program=sys.executable):
    """The program of this version is never started: any that can be stands for it."""
    return subprocess.run([sys.executable, ROOT / 'tools/compare_versions', *arguments], capture_output=True, text=True,
                          env={**os.environ, 'STRANDLAB': program})


class CompareVersions(unittest.TestCase):
    def expect_usage_error(self, result, *parts):
        self.assertEqual(result.returncode, 2, result.stderr)
        self.assertEqual(result.stdout, '')
        self.assertEqual(len(result.stderr.splitlines()), 1, result.stderr)
        self.assertTrue(result.stderr.startswith('compare_versions: '), result.stderr)
        for part in parts:
            self.assertIn(part, result.stderr)

    def test_options_that_are_wrong(self):
        for arguments, parts in [
                ([], ['COMMIT is missing', 'tools/compare_versions --help']),
                (['--rounds', '3'], ['COMMIT is missing']),
                (['HEAD', '--rounds'], ['--rounds', 'expected one argument']),
                (['HEAD', '--rounds', '0'], ['--rounds', "'0' is not a number from 1 to 10000"]),
                (['HEAD', '--repeat', 'x'], ['--repeat', "'x' is not"]),
                (['HEAD', '--repeat', '\u0663'], ['--repeat', 'is not a number']),
                (['HEAD', '--roundz', '3'], ['--roundz']),
                (['HEAD', '--json', 'x'], ['--json'])]:
            with self.subTest(arguments=arguments):
                self.expect_usage_error(run(*arguments), *parts)

    def test_commits_that_are_none(self):
        for name in ['no-such-branch', '0123456789012345678901234567890123456789', '', 'HEAD^{tree}']:
            with self.subTest(name=name):
                result = run('--', name)
                self.expect_usage_error(result, 'COMMIT is missing' if name == '' else f"'{name}' is no commit")

    def test_a_commit_before_the_benchmark(self):
        roots = subprocess.run(['git', '-C', ROOT, 'rev-list', '--max-parents=0', 'HEAD'], capture_output=True, text=True)
        if roots.returncode != 0 or not roots.stdout.strip():
            self.skipTest('no history of the repository here')
        oldest = roots.stdout.split()[0]
        bench = ['git', '-C', ROOT, 'cat-file', '-e', oldest + ':source/commands/bench.cpp']
        if subprocess.run(bench, capture_output=True).returncode == 0:
            self.skipTest('the history here is cut off')
        self.expect_usage_error(run(oldest), oldest, 'no command bench')

    def test_no_program(self):
        for program in ['/nowhere/strandlab', str(ROOT)]:
            self.expect_usage_error(run('HEAD', program=program), f'no program {program}', 'tools/bench', 'STRANDLAB')

    def test_help(self):
        result = run('--help')
        self.assertEqual((result.returncode, result.stderr), (0, ''))
        for part in ['COMMIT', '--rounds', '--primitive', 'build-versions/']:
            self.assertIn(part, result.stdout)


unittest.main()
