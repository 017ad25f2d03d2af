/**
 * The default export of an ES module that bundlers cannot know.
 *
 * @param address Absolute, or relative to the page.
 */
export async function importDefault(address: string | URL): Promise<unknown> {
  const { href } = new URL(address, document.baseURI);
  const module: unknown = await import(/* webpackIgnore: true */ /* turbopackIgnore: true */ /* @vite-ignore */ href);
  return (module as { readonly default: unknown }).default;
}
