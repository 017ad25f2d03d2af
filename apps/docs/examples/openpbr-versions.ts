import {
  fromOpenPbr12,
  type OpenPbr12Parameters,
} from '@glanz/openpbr/versions';

// #region convert
export function drawable(draft: OpenPbr12Parameters) {
  const { parameters, lost } = fromOpenPbr12(draft);
  for (const { parameter, reason } of lost)
    console.warn(`${parameter}: ${reason}`);
  return parameters;
}

// { emission_color, emission_luminance: 500 }: half of the 1000 by default
const glowing = drawable({
  emission_weight: 0.5,
  emission_color: [1, 0.8, 0.6],
});
// #endregion convert

export { glowing };
