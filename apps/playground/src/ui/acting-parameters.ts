import { openpbr, openpbrEmission, openpbrOpacity, OPENPBR_PARAMETERS, openPbrStruct, type OpenPbrParameterInfo } from '@glanz/openpbr';
import type { WgslModule } from '@glanz/wgsl';

/** All WGSL text of modules and what they need, the parameter record itself left out. */
function textOf(roots: readonly WgslModule[]): string {
  const seen = new Set<WgslModule>([openPbrStruct.module]);
  const visit = (module: WgslModule): string => {
    if (seen.has(module)) return '';
    seen.add(module);
    return module.code + module.deps.map((dependency) => visit('module' in dependency ? dependency.module : dependency)).join('');
  };
  return roots.map(visit).join('');
}

/** The parameters that change the picture: those that the shaders read. A control that does nothing would be a lie. */
export function actingParameters(): OpenPbrParameterInfo[] {
  const text = textOf([openpbr, openpbrEmission, openpbrOpacity]);
  const infos: OpenPbrParameterInfo[] = Object.values(OPENPBR_PARAMETERS);
  return infos.filter(({ name, type }) => type !== 'vector3' && new RegExp(`\\.${name}\\b`).test(text));
}
