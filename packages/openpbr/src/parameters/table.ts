import { OPENPBR_PARAMETER_SPECS } from './specs';
import { texts } from './texts';
import type { OpenPbrParameterInfo, OpenPbrParameterName } from './types';

type Table = { readonly [Name in OpenPbrParameterName]: OpenPbrParameterInfo<Name> };

// A function, so that bundlers can drop the table where it is not used.
const table = (): Table =>
  Object.fromEntries(
    Object.values(OPENPBR_PARAMETER_SPECS).map((spec) => [
      spec.name,
      Object.freeze({ ...spec, doc: texts[spec.name] }),
    ]),
  ) as unknown as Table;

/**
 * The parameter table of OpenPBR Surface 1.1.1, with three of the draft of 1.2 (`draft`), as data: names, types,
 * defaults, hard and soft ranges, units, groups and documentation, in the specification's order. Validation and importers read it without the texts, see
 * {@link OPENPBR_PARAMETER_SPECS}.
 *
 * @example
 * for (const info of Object.values(OPENPBR_PARAMETERS)) addSlider(info.name, info.softRange, info.doc);
 */
export const OPENPBR_PARAMETERS: Table = /* @__PURE__ */ Object.freeze(/* @__PURE__ */ table());
