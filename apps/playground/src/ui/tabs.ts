import { byId } from './elements';

export const TABS = ['scene', 'material', 'light', 'camera', 'render'] as const;
export type Tab = (typeof TABS)[number];

/** The tabs beside the image: arrows move between them, as in every tab list. */
export function wireTabs(onChange: (tab: Tab) => void): (tab: Tab) => void {
  const buttons = TABS.map((tab) => byId<HTMLButtonElement>(`tab-${tab}`));
  const choose = (tab: Tab, focus = false) => {
    document.body.dataset['tab'] = tab;
    for (const [i, button] of buttons.entries()) {
      button.setAttribute('aria-selected', String(TABS[i] === tab));
      button.tabIndex = TABS[i] === tab ? 0 : -1;
      if (focus && TABS[i] === tab) button.focus();
    }
    onChange(tab);
  };
  for (const [i, button] of buttons.entries()) {
    button.addEventListener('click', () => choose(TABS[i] as Tab));
    button.addEventListener('keydown', (event) => {
      const step = event.key === 'ArrowRight' ? 1 : event.key === 'ArrowLeft' ? -1 : 0;
      if (step === 0) return;
      event.preventDefault();
      const shown = TABS.filter((_, k) => (buttons[k] as HTMLElement).offsetParent !== null);
      const at = shown.indexOf(TABS[i] as Tab);
      choose(shown[(at + step + shown.length) % shown.length] as Tab, true);
    });
  }
  // A wide window has the scene beside the image, without a tab.
  addEventListener('resize', () => buttons.find(({ tabIndex }) => tabIndex === 0)?.offsetParent ?? choose('material'));
  choose((document.body.dataset['tab'] as Tab | undefined) ?? 'material');
  return choose;
}
