import { gated, wgslModule } from '@glanz/wgsl';
import { openpbrCoat } from './coat.wgsl';
import { openpbrDielectric } from './dielectric.wgsl';

/**
 * `openpbr_interfaces_seen(interfaces, wanted, …)`: the interfaces of a surface as they are seen; one that is not
 * wanted may be left as `openpbr_dielectric` made it. Where they are summed over facets they are gone through by one
 * loop, since compilers copy a function to every place that calls it; it goes by bits, so that nobody unrolls it.
 */
export const openpbrInterfaces = wgslModule(
  'openpbr/interfaces',
  /* wgsl */ `struct OpenPbrInterfaces {
  //#if OPENPBR_DIELECTRIC
  base: OpenPbrDielectric,
  //#endif
  //#if OPENPBR_TRANSMISSION
  // That of the clear part, without what a coat does to its index.
  bare: OpenPbrDielectric,
  //#endif
  //#if OPENPBR_COAT
  coat: OpenPbrDielectric,
  //#endif
}

// Bits of what is wanted.
const OPENPBR_SEE_BASE = 1u;
const OPENPBR_SEE_BARE = 2u;
//#if OPENPBR_COAT
const OPENPBR_SEE_COAT = 4u;

// "coat" has its shape.
fn openpbr_interfaces_seen(given: OpenPbrInterfaces, wanted: u32, alpha: vec2f, wo: vec3f, coat: OpenPbrCoat) -> OpenPbrInterfaces {
//#else
fn openpbr_interfaces_seen(given: OpenPbrInterfaces, wanted: u32, alpha: vec2f, wo: vec3f) -> OpenPbrInterfaces {
//#endif
  var all = given;
  //#if OPENPBR_INTERFACE_LOOP
  for (var left = wanted; left != 0u; left &= left - 1u) {
    let which = left & (~left + 1u);
    var d = all.base;
    var slopes = alpha;
    var view = wo;
    //#if OPENPBR_TRANSMISSION
    if (which == OPENPBR_SEE_BARE) { d = all.bare; }
    //#endif
    //#if OPENPBR_COAT
    if (which == OPENPBR_SEE_COAT) {
      d = all.coat;
      slopes = coat.alpha;
      view = openpbr_coat_view(coat, wo);
    }
    //#endif
    d = openpbr_dielectric_seen(d, slopes, view);
    if (which == OPENPBR_SEE_BASE) { all.base = d; }
    //#if OPENPBR_TRANSMISSION
    if (which == OPENPBR_SEE_BARE) { all.bare = d; }
    //#endif
    //#if OPENPBR_COAT
    if (which == OPENPBR_SEE_COAT) { all.coat = d; }
    //#endif
  }
  //#else
  //#if OPENPBR_DIELECTRIC
  all.base = openpbr_dielectric_seen(all.base, alpha, wo);
  //#endif
  //#if OPENPBR_TRANSMISSION
  if ((wanted & OPENPBR_SEE_BARE) != 0u) { all.bare = openpbr_dielectric_seen(all.bare, alpha, wo); }
  //#endif
  //#if OPENPBR_COAT
  all.coat = openpbr_dielectric_seen(all.coat, coat.alpha, openpbr_coat_view(coat, wo));
  //#endif
  //#endif
  return all;
}`,
  [openpbrDielectric, gated('OPENPBR_COAT', openpbrCoat)],
);
