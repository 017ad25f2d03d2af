interface Named {
  readonly name: string;
  readonly description: string;
}

interface CustomElement extends Named {
  readonly tagName: string;
  readonly attributes: readonly (Named & {
    readonly fieldName: string;
    readonly type: { readonly text: string };
    readonly default?: string;
  })[];
  readonly members: readonly (Named & { readonly kind: string; readonly attribute?: string })[];
  readonly events: readonly (Named & { readonly type: { readonly text: string } })[];
  readonly slots: readonly Named[];
  readonly cssParts: readonly Named[];
  readonly cssProperties: readonly Named[];
}

/** The manifest of the package in `folder`, as data; the schema is that of custom-elements-manifest 1.0.0. */
export function customElements(folder?: string): {
  readonly schemaVersion: string;
  readonly modules: readonly { readonly path: string; readonly declarations: readonly CustomElement[] }[];
};
