#!/usr/bin/env node
import { runCli } from './run';

// Not process.exit(): what has been written to the streams must get out.
process.exitCode = await runCli(process.argv.slice(2));
