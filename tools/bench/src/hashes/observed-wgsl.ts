// Replaces @glanz/wgsl for the renderer in the bundle of `hashes`: the programs and flags that it composes
// are nowhere else to be seen, since a kernel that is compiled already is not compiled again.
import { compose as composeUnseen, type ComposedWgsl, type ComposeOptions, type WgslModule } from '@glanz/wgsl';

export * from '@glanz/wgsl';

/** A program that has been composed. */
export interface ObservedProgram {
  /** Name of the module with the entry point, e.g. `renderer/shade`. */
  readonly kernel: string;
  readonly code: string;
  readonly flags: Readonly<Record<string, boolean>>;
}

// The bundle has one instance of this file for the renderer and one for the benchmark.
const observer = globalThis as { glanzProgramObserver?: ((program: ObservedProgram) => void) | undefined };

/** Reports every program from now on; `undefined` stops it. */
export function observePrograms(report: ((program: ObservedProgram) => void) | undefined): void {
  observer.glanzProgramObserver = report;
}

/** As in @glanz/wgsl. */
export function compose(roots: readonly WgslModule[], options: ComposeOptions = {}): ComposedWgsl {
  const composed = composeUnseen(roots, options);
  observer.glanzProgramObserver?.({
    kernel: composed.modules.at(-1) ?? '',
    code: composed.code,
    flags: options.flags ?? {},
  });
  return composed;
}
