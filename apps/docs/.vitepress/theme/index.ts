import type { Theme } from 'vitepress';
import { defineAsyncComponent, h } from 'vue';
import DefaultTheme from 'vitepress/theme-without-fonts';
import HomeGallery from './HomeGallery.vue';
import HomeViewer from './HomeViewer.vue';
import LiveBall from './LiveBall.vue';
import LiveHierarchy from './LiveHierarchy.vue';
import LiveParameters from './LiveParameters.vue';
import LiveImage from './LiveImage.vue';
import LiveSphere from './LiveSphere.vue';
import LivePushButton from './LivePushButton.vue';
import ParameterTable from './ParameterTable.vue';
import './style.css';

export default {
  extends: DefaultTheme,
  Layout: () =>
    h(DefaultTheme.Layout, null, { 'home-hero-image': () => h(HomeViewer), 'home-hero-after': () => h(HomeGallery) }),
  enhanceApp({ app, router }) {
    // As in the built pages, for pages that are opened by a link within the site.
    router.onAfterRouteChange = () => {
      const content = typeof document === 'undefined' ? null : document.getElementById('VPContent');
      if (content?.classList.contains('is-home')) content.setAttribute('role', 'main');
      else content?.removeAttribute('role');
    };
    // Loaded on demand with their data, which most pages do not need.
    app.component(
      'FigureGrid',
      defineAsyncComponent(() => import('./FigureGrid.vue')),
    );
    app.component(
      'FigureTable',
      defineAsyncComponent(() => import('./FigureTable.vue')),
    );
    app.component(
      'GalleryGrid',
      defineAsyncComponent(() => import('./GalleryGrid.vue')),
    );
    app.component(
      'ResultPlot',
      defineAsyncComponent(() => import('./ResultPlot.vue')),
    );
    app.component('LiveBall', LiveBall);
    app.component('LiveHierarchy', LiveHierarchy);
    app.component('LiveParameters', LiveParameters);
    app.component('LiveImage', LiveImage);
    app.component('LiveSphere', LiveSphere);
    app.component('LivePushButton', LivePushButton);
    app.component('ParameterTable', ParameterTable);
  },
} satisfies Theme;
