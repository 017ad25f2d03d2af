import type { WgslModule } from '@glanz/wgsl';

/** The modules of the renderer with these names, among those that a module needs. */
export function modulesOf(root: WgslModule, names: readonly string[]): WgslModule[] {
  const found = new Map<string, WgslModule>();
  const visit = (module: WgslModule): void => {
    if (found.has(module.name)) return;
    found.set(module.name, module);
    for (const dep of module.deps) visit('flag' in dep ? dep.module : dep);
  };
  visit(root);
  return names.map((name) => found.get(`renderer/${name}`) as WgslModule);
}
