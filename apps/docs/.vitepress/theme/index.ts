import { h } from 'vue';
import type { Theme } from 'vitepress';
import DefaultTheme from 'vitepress/theme-without-fonts';
import FigureGrid from './FigureGrid.vue';
import FigureTable from './FigureTable.vue';
import GalleryGrid from './GalleryGrid.vue';
import ResultPlot from './ResultPlot.vue';
import HomeGallery from './HomeGallery.vue';
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
  Layout: () => h(DefaultTheme.Layout, null, { 'home-hero-after': () => h(HomeGallery) }),
  enhanceApp({ app, router }) {
    // As the built pages say it, for those who come here by a link.
    router.onAfterRouteChange = () => {
      const content = typeof document === 'undefined' ? null : document.getElementById('VPContent');
      if (content?.classList.contains('is-home')) content.setAttribute('role', 'main');
      else content?.removeAttribute('role');
    };
    app.component('FigureGrid', FigureGrid);
    app.component('FigureTable', FigureTable);
    app.component('GalleryGrid', GalleryGrid);
    app.component('ResultPlot', ResultPlot);
    app.component('LiveBall', LiveBall);
    app.component('LiveHierarchy', LiveHierarchy);
    app.component('LiveParameters', LiveParameters);
    app.component('LiveImage', LiveImage);
    app.component('LiveSphere', LiveSphere);
    app.component('LivePushButton', LivePushButton);
    app.component('ParameterTable', ParameterTable);
  },
} satisfies Theme;
