/** What one package may import of another. */
export interface Arrow {
  readonly typesOnly: boolean;
  readonly errorOnly: boolean;
}

export function readArrows(markdown: string): Map<string, Map<string, Arrow>>;
export function findCycle<Node>(nodes: readonly Node[], next: (node: Node) => readonly Node[]): Node[] | undefined;
export function readImports(text: string, fileName?: string): { specifier: string; line: number; typeOnly: boolean }[];
