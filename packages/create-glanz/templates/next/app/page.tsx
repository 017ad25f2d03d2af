import { Product } from './product';

export default function Page() {
  return <Product src="/push-button.glb" name="A push-button" />;
}
