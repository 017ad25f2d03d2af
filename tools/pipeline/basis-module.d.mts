export const BASIS_MODULE: string;
export function withDefault(text: string, path: string): string;
export function basisModule(): {
  readonly name: string;
  readonly config: () => { readonly optimizeDeps: { exclude: string[] } };
  readonly transform: (code: string, id: string) => { code: string; map: null } | undefined;
};
