import { parseConvert } from './commands/convert';
import { parseBench } from './commands/bench';
import { parseFarm } from './commands/farm/parse';
import { parseInfo } from './commands/info';
import { parseMerge } from './commands/merge';
import { parseServe } from './commands/serve';
import { parseVideo } from './commands/video';
import { checkPlaceholders } from './output/placeholders';
import {
  closest,
  parseOptions,
  presentNames,
  renderOptions,
  usage,
  type RenderCommand,
  type ReportOptions,
} from './options';

/** What the command line asks for. */
export type Command =
  | { readonly kind: 'help'; readonly topic: string | undefined }
  | { readonly kind: 'version' }
  | ({ readonly kind: 'list-gpus' } & ReportOptions)
  | ReturnType<typeof parseConvert>
  | ReturnType<typeof parseInfo>
  | ReturnType<typeof parseBench>
  | ReturnType<typeof parseServe>
  | ReturnType<typeof parseMerge>
  | ReturnType<typeof parseFarm>
  | ReturnType<typeof parseVideo>
  | RenderCommand;

/**
 * Reads the command line.
 *
 * @throws {CliError} `cli/usage`, with what to do about it.
 */
export function parseCommand(argv: readonly string[]): Command {
  const [first] = argv;
  const help = argv.includes('--help') || argv.includes('-h');
  if (first === 'help' || help)
    return { kind: 'help', topic: first === 'help' ? argv[1] : first?.startsWith('-') ? undefined : first };
  if (first === 'convert') return parseConvert(argv.slice(1));
  if (first === 'info') return parseInfo(argv.slice(1));
  if (first === 'bench') return parseBench(argv.slice(1));
  if (first === 'serve') return parseServe(argv.slice(1));
  if (first === 'merge') return parseMerge(argv.slice(1));
  if (first === 'video') return parseVideo(argv.slice(1));
  if (first === 'farm') return parseFarm(argv.slice(1));
  const { values: given, positionals } = parseOptions(argv);
  const warnings: string[] = [];
  const values = presentNames(given, (text) => warnings.push(text));
  if (values.version) return { kind: 'version' };
  const report: ReportOptions = { json: values.json ?? false, quiet: values.quiet ?? false };
  if (values['list-gpus']) return { kind: 'list-gpus', ...report };
  const [command, model, ...rest] = positionals;
  if (command === undefined) {
    if (argv.length === 0) return { kind: 'help', topic: undefined };
    throw usage('No command given. Use glanz render MODEL; see glanz --help.');
  }
  const commands = ['render', 'convert', 'info', 'bench', 'serve', 'merge', 'farm', 'video'];
  if (command !== 'render') {
    if (commands.includes(command)) throw usage(`"${command}" comes first: glanz ${command} …; see glanz --help.`);
    const guess = closest(command, commands);
    throw usage(
      `Unknown command "${command}".${guess ? ` Did you mean glanz ${guess}?` : ' Use glanz render MODEL;'} See glanz --help.`.replace(
        '; See',
        '; see',
      ),
    );
  }
  if (rest.length > 0)
    throw usage(`One model at a time: unexpected argument "${rest[0]}". For several models, use --batch FILE.`);
  if (model === undefined && values.batch === undefined)
    throw usage('No model given. Use glanz render MODEL, a .glb or .gltf file.');
  if (values['output-root'] !== undefined && values.batch === undefined)
    throw usage('--output-root limits where a batch file may write, and belongs to --batch.');
  if (values.checkpoint !== undefined) checkPlaceholders(values.checkpoint, '--checkpoint');
  return {
    kind: 'render',
    ...report,
    options: values.batch === undefined ? renderOptions(values, model as string) : undefined,
    batch: values.batch,
    outputRoot: values['output-root'],
    values: { ...values, model },
    resume: values.resume ?? false,
    checkpoint: values.checkpoint,
    warnings,
    gpus: values.gpu ?? [],
  };
}
