/** What is known of one archive of weights. */
export interface WeightArchive {
  /** Size of the file. */
  readonly bytes: number;
  /** SHA-256 of the file, hexadecimal. The build compares it, and so does `readWeights` of the entry `node`. */
  readonly sha256: string;
}

/**
 * The archives of this package, by the names that Open Image Denoise gives them. Each is a file `weights/NAME.tza`
 * (TZA 2.0, 16-bit floats), byte for byte as in Open Image Denoise 2.5.1.
 *
 * `rt_hdr`, `rt_ldr`: networks for colour that is linear and unbounded, or between 0 and 1. `_alb`, `_nrm`: with albedo
 * and normal as guides; `_calb_cnrm`: with guides that are free of noise. `rt_alb`, `rt_nrm`: networks that remove the
 * noise of the guides. `_small`, `_large`: the other two sizes.
 */
export const WEIGHT_ARCHIVES = {
  rt_alb: {
    bytes: 1830792,
    sha256: '752c9a8d57884d660ae375a7c853cad8a44f77d559bb282f0ef39f8e758601a4',
  },
  rt_alb_large: {
    bytes: 7684615,
    sha256: 'a8efbe6eed511f41c8f5ff9145923214cefb0703cf91a3b00a1dc131ade1600a',
  },
  rt_hdr: {
    bytes: 1830792,
    sha256: 'a097e8fe9b1ba71ec43cde3e6df3fcf54fa4f8f2f4dd41eac01d0a76a16261e3',
  },
  rt_hdr_alb: {
    bytes: 1835976,
    sha256: 'a8e4fbbd3a794e0098f88e23882faf5459840bda5b0ff39f22bcaaf2cfd03b5a',
  },
  rt_hdr_alb_nrm: {
    bytes: 1841160,
    sha256: 'e586ef2ff48d7fbb7611986405220ed8fc5c13ca79bfc40be4dc742fbf959e1a',
  },
  rt_hdr_alb_nrm_small: {
    bytes: 641480,
    sha256: '980ea307e7825cae23ed8b1addf8de62ece84b61094795a5631ebf1c91b2e1a7',
  },
  rt_hdr_alb_small: {
    bytes: 638024,
    sha256: '1f3839dfc949e969bc5ad4d600e85bfa96187e0cb5ffee2f4715c791e6221fba',
  },
  rt_hdr_calb_cnrm: {
    bytes: 1841160,
    sha256: 'd0057057bd76c64e3e67b449728ef8f4fd2f11ccfb74c1e59b9d50dafd50ee0e',
  },
  rt_hdr_calb_cnrm_large: {
    bytes: 7698439,
    sha256: '08130cdc4f33b7a513d0073757f089ac830f900613bb5bad72ca42c52b934465',
  },
  rt_hdr_calb_cnrm_small: {
    bytes: 641480,
    sha256: 'a6c43bfdbff01bdd8a9c777e139720f9e58b872a50c8db07079bddd007482dc5',
  },
  rt_hdr_small: {
    bytes: 634568,
    sha256: 'c9171947f2bceb4367725b7a0d5b4e0d663ac44108386af42f1b49e4361952e7',
  },
  rt_ldr: {
    bytes: 1830792,
    sha256: 'ad35b8fe765d453ade41861e90ee1da66e0b5fe35136de7763b64098a682e3ab',
  },
  rt_ldr_alb: {
    bytes: 1835976,
    sha256: 'd7402ccf5dc632bb2a6b14917f0bc143315765e29dd2227533ce3e75546d0e4c',
  },
  rt_ldr_alb_nrm: {
    bytes: 1841160,
    sha256: 'eae7f05c02ed49c0b267454818013736a0bdd90483dae2ffd7a120acff87cc0b',
  },
  rt_ldr_alb_nrm_small: {
    bytes: 641480,
    sha256: '919609e048fe78fa1d60afe562f10daf1552872542f6eda6703d48e1c99426f1',
  },
  rt_ldr_alb_small: {
    bytes: 638024,
    sha256: '1deb0b14b52368140e92cdff59469e37ff2922cda78d0872aa0a78234b879fb1',
  },
  rt_ldr_calb_cnrm: {
    bytes: 1841160,
    sha256: '165d86fe5d13de1f623d45eb9cdd2202d4b8a0e1500b136c464739020cf8f4ce',
  },
  rt_ldr_calb_cnrm_small: {
    bytes: 641480,
    sha256: '3777cc3446e9cee4cfc0f577b717068466bc72d8a344748a01266882dd7a398a',
  },
  rt_ldr_small: {
    bytes: 634568,
    sha256: 'd50ad6ca693ec8f2bdfac5d4657c4cb7c0763b20a9768e66f0402a00046b704c',
  },
  rt_nrm: {
    bytes: 1830792,
    sha256: 'fb8f7f5571332b602406f88a0b570d809dd3c06aebb530f5d048828f57490bc7',
  },
  rt_nrm_large: {
    bytes: 7684615,
    sha256: '8ac7705ec5ac303116b40ad2f0880cd741ed1f4280828bf2f18f7635c3377257',
  },
} as const satisfies Readonly<Record<string, WeightArchive>>;

/** Name of an archive of {@link WEIGHT_ARCHIVES}. */
export type WeightArchiveName = keyof typeof WEIGHT_ARCHIVES;
