#!/usr/bin/env node
import { createInterface } from 'node:readline/promises';
import { runCommand } from './command';

const { stdin, stdout, stderr } = process;

/** A closed input (Ctrl+D) means the initial answer; Ctrl+C ends the process. */
async function ask(question: string, initial: string): Promise<string> {
  const lines = createInterface({ input: stdin, output: stdout });
  try {
    const closed = new Promise<string>((resolve) => lines.once('close', () => resolve('')));
    const answer = await Promise.race([lines.question(`${question} (${initial}): `), closed]);
    return answer.trim() || initial;
  } finally {
    lines.close();
  }
}

process.exitCode = await runCommand(process.argv.slice(2), {
  cwd: process.cwd(),
  userAgent: process.env['npm_config_user_agent'],
  print: (line) => void stdout.write(`${line}\n`),
  printError: (line) => void stderr.write(`${line}\n`),
  ...(stdin.isTTY && stdout.isTTY ? { ask } : {}),
});
