/** What the waiting changesets add up to. */
export interface ReleasePlan {
  readonly changesets: readonly {
    readonly releases: readonly { readonly name: string; readonly type: string }[];
  }[];
  readonly releases: readonly { readonly name: string; readonly type: string; readonly newVersion: string }[];
}

export function releasePlan(base?: string): Promise<ReleasePlan>;
export function accidentalMajors(plan: ReleasePlan): string[];
