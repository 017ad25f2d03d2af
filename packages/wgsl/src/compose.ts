import { GlanzError } from './error';
import type { GatedDependency, WgslModule } from './module';

/**
 * Thrown by {@link compose}. Codes:
 *
 * - `wgsl/cycle`: modules depend on each other in a circle. Remove one of the imports that the message lists.
 * - `wgsl/unknown-flag`: a module asks for a flag that was not passed. Pass every flag, `false` included.
 * - `wgsl/unbalanced-gate`: an `//#if` has no `//#endif`, or the reverse. Add it at the line of `location`.
 * - `wgsl/duplicate-name`: two modules have the same name. Prefix names with your package's.
 */
export class WgslComposeError extends GlanzError {}

/** Options for {@link compose}. */
export interface ComposeOptions {
  /** Every flag that any composed text mentions must be given here: a missing one is an error, not `false`. */
  readonly flags?: Readonly<Record<string, boolean>>;
}

/** The origin of a line of the composed text. */
export interface WgslLocation {
  /** Name of the {@link WgslModule}. */
  readonly module: string;
  /** 1-based line inside that module's `code`. */
  readonly line: number;
}

/** The result of {@link compose}. */
export interface ComposedWgsl {
  /** The whole shader text. */
  readonly code: string;
  /** Names of the modules in it, in order. */
  readonly modules: readonly string[];
  /** Maps a 1-based line of `code` back to its module; `undefined` outside of it. */
  locate(line: number): WgslLocation | undefined;
}

interface Gate {
  readonly line: number;
  /** Whether the text around it is kept. */
  readonly outer: boolean;
  readonly met: boolean;
  elseSeen?: boolean;
}

/** Anywhere in a line: a keyword, and after `if` its flags. */
const GATE = /\/\/#(\w*)(?:(?<=#if)\s+(!?\w+(?:\s*&&\s*!?\w+)*))?/;

/** `enable f16;`, `requires …;`, `diagnostic(…);`: WGSL takes them only before all declarations. */
const DIRECTIVE = /^\s*(?:enable\s|requires\s|diagnostic\s*\().*;\s*$/;

/** @param line Line of the gate; absent for a gated dependency. */
function flagValue(flags: Readonly<Record<string, boolean>>, name: string, module: string, line?: number): boolean {
  if (!Object.hasOwn(flags, name)) {
    const where = line === undefined ? `"${module}"` : `"${module}" line ${line}`;
    throw new WgslComposeError(
      'wgsl/unknown-flag',
      `WGSL module ${where} asks for the flag "${name}", which was not given. Known flags: ${Object.keys(flags).sort().join(', ') || 'none'}.`,
      {
        location: line === undefined ? { module } : { module, line },
      },
    );
  }
  return flags[name] === true;
}

/** Calls `emit` with each line of the module's text, or the part of it, that its gates keep. */
function forEachKeptLine(
  module: WgslModule,
  flags: Readonly<Record<string, boolean>>,
  emit: (text: string, line: number) => void,
): void {
  const gates: Gate[] = [];
  let live = true;
  let line = 0;
  const unbalanced = (what: string) =>
    new WgslComposeError('wgsl/unbalanced-gate', `WGSL module "${module.name}" line ${line}: ${what}.`, {
      location: { module: module.name, line },
    });
  for (const text of module.code.split('\n')) {
    line++;
    // Text, keyword, flags, text, keyword, flags, text, …
    const parts = text.split(GATE);
    let kept = live ? (parts[0] as string) : '';
    for (let i = 1; i < parts.length; i += 3) {
      const kind = parts[i] as string;
      const gate = gates[gates.length - 1];
      if (kind === 'if') {
        if (!parts[i + 1]) throw unbalanced('//#if without a flag');
        const met = (parts[i + 1] as string)
          .split('&&')
          .every((part) => flagValue(flags, part.replace('!', '').trim(), module.name, line) !== part.includes('!'));
        gates.push({ line, outer: live, met });
        live &&= met;
      } else if (kind !== 'else' && kind !== 'endif')
        throw unbalanced(`"${text.trim()}" is not a gate (//#if FLAG, //#else, //#endif)`);
      else if (!gate) throw unbalanced(`//#${kind} without //#if`);
      else if (kind === 'endif') live = (gates.pop() as Gate).outer;
      else {
        if (gate.elseSeen) throw unbalanced('second //#else');
        gate.elseSeen = true;
        live = gate.outer && !gate.met;
      }
      if (live) kept += parts[i + 2] as string;
    }
    if (parts.length > 1 ? kept.trim() : live) emit(kept, line);
  }
  const open = gates.pop();
  if (open) {
    line = open.line;
    throw unbalanced('//#if is never closed');
  }
}

/** Dependencies before dependents, each module once, in a stable order. */
function order(roots: readonly WgslModule[], flags: Readonly<Record<string, boolean>>): WgslModule[] {
  const done = new Set<WgslModule>();
  const names = new Map<string, WgslModule>();
  const path: WgslModule[] = [];
  const result: WgslModule[] = [];
  const visit = (module: WgslModule): void => {
    if (done.has(module)) return;
    if (path.includes(module)) {
      const cycle = [...path.slice(path.indexOf(module)), module].map((m) => m.name).join(' → ');
      throw new WgslComposeError('wgsl/cycle', `WGSL modules depend on each other in a cycle: ${cycle}.`, {
        location: { module: module.name },
      });
    }
    const namesake = names.get(module.name);
    if (namesake && namesake !== module) {
      throw new WgslComposeError('wgsl/duplicate-name', `Two different WGSL modules are called "${module.name}".`, {
        location: { module: module.name },
      });
    }
    names.set(module.name, module);
    path.push(module);
    for (const dep of module.deps) {
      if (!isGated(dep)) visit(dep);
      else if (flagValue(flags, dep.flag, module.name) === dep.value) visit(dep.module);
    }
    path.pop();
    done.add(module);
    result.push(module);
  };
  for (const root of roots) visit(root);
  return result;
}

function isGated(dep: WgslModule | GatedDependency): dep is GatedDependency {
  return 'flag' in dep;
}

/**
 * Composes WGSL modules into one shader text: dependencies first, each module once, without text that is gated off.
 * Leaving text out keeps pipelines quick to compile; `override` constants do not prune.
 * Directives (`enable`, `requires`, `diagnostic`), one a line, move to the top, each once.
 *
 * @param roots The modules that hold the entry points, or any others to include.
 * @throws {WgslComposeError} on cycles, unknown flags, unbalanced gates, or duplicate module names.
 * @example
 * const shader = compose([traceKernel], { flags: { COAT: false } });
 * device.createShaderModule({ code: shader.code });
 */
export function compose(roots: readonly WgslModule[], options: ComposeOptions = {}): ComposedWgsl {
  const flags = options.flags ?? {};
  const directives = new Map<string, WgslLocation>();
  const texts: string[] = [];
  const places: WgslLocation[] = [];
  const modules = order(roots, flags);
  for (const module of modules) {
    forEachKeptLine(module, flags, (text, line) => {
      const place = { module: module.name, line };
      if (DIRECTIVE.test(text)) {
        if (!directives.has(text.trim())) directives.set(text.trim(), place);
        return;
      }
      texts.push(text);
      places.push(place);
    });
  }
  places.unshift(...directives.values());
  return {
    code: `${[...directives.keys(), ...texts].join('\n')}\n`,
    modules: modules.map((m) => m.name),
    locate: (line) => places[line - 1],
  };
}
