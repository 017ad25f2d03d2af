import { appendFileSync, existsSync, readFileSync } from 'node:fs';
import type { Outcome } from './outcome';

/** What a trial is, before it is known how it ends. */
export type TrialName = Pick<Outcome, 'subject' | 'point' | 'fault'>;

type Line = { readonly begun: TrialName } | { readonly ended: Outcome } | { readonly missed: TrialName };

const keyOf = ({ subject, point, fault }: TrialName) => `${subject} ${fault} ${point}`;

/**
 * The trials of a campaign and how they ended. With a file each trial is noted there as it begins and ends, one JSON
 * value a
 * line: a run that was interrupted resumes where it stopped, and a trial that ended its process is known by name.
 */
export class Journal {
  readonly #file: string | undefined;
  readonly #ended = new Map<string, Outcome>();
  readonly #missed = new Map<string, TrialName>();
  #running: TrialName | undefined;

  /** @param file Read if it is there, and appended to. */
  constructor(file?: string) {
    this.#file = file;
    if (file === undefined || !existsSync(file)) return;
    for (const text of readFileSync(file, 'utf8').split('\n')) {
      if (text === '') continue;
      let line: Line;
      try {
        line = JSON.parse(text) as Line;
      } catch {
        // The last line of a process that was killed while it wrote.
        continue;
      }
      if ('begun' in line) this.#running = line.begun;
      else if ('ended' in line) this.#end(line.ended);
      else this.#miss(line.missed);
    }
  }

  /** How the trials ended, in the order in which they were made. */
  get outcomes(): readonly Outcome[] {
    return [...this.#ended.values()];
  }

  /** Trials whose call did not come. */
  get missed(): readonly TrialName[] {
    return [...this.#missed.values()];
  }

  /** The trial that has begun and not ended. */
  get running(): TrialName | undefined {
    return this.#running;
  }

  /** Whether a trial has been made. */
  has(trial: TrialName): boolean {
    const key = keyOf(trial);
    return this.#ended.has(key) || this.#missed.has(key);
  }

  begin({ subject, point, fault }: TrialName): void {
    this.#running = { subject, point, fault };
    this.#write({ begun: this.#running });
  }

  end(outcome: Outcome): void {
    this.#end(outcome);
    this.#write({ ended: outcome });
  }

  /** The call of a trial did not come. */
  miss({ subject, point, fault }: TrialName): void {
    this.#miss({ subject, point, fault });
    this.#write({ missed: { subject, point, fault } });
  }

  #end(outcome: Outcome): void {
    this.#ended.set(keyOf(outcome), outcome);
    this.#running = undefined;
  }

  #miss(trial: TrialName): void {
    this.#missed.set(keyOf(trial), trial);
    this.#running = undefined;
  }

  #write(line: Line): void {
    if (this.#file !== undefined) appendFileSync(this.#file, `${JSON.stringify(line)}\n`);
  }
}
