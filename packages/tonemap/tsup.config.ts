import { glanzPackage } from '../../tsup.base';

export default glanzPackage({
  index: 'src/index.ts',
  'tone-map': 'src/tone-map.ts',
  pass: 'src/pass.ts',
  neutral: 'src/neutral.ts',
  aces: 'src/aces.ts',
  agx: 'src/agx.ts',
  reinhard: 'src/reinhard.ts',
  linear: 'src/linear.ts',
  srgb: 'src/srgb.ts',
  'css-color': 'src/css-color.ts',
});
