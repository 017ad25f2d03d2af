import { byId } from './elements';

const THEMES = ['', 'light', 'dark'] as const;

/** The button that cycles through the themes; the choice stays in this browser. */
export function wireTheme(): void {
  const button = byId<HTMLButtonElement>('theme');
  const root = document.documentElement;
  const show = () => {
    const theme = THEMES.find((name) => name === root.dataset['theme']) ?? '';
    button.title = `Theme: ${theme || 'system'}`;
    button.setAttribute('aria-label', button.title);
    return theme;
  };
  button.addEventListener('click', () => {
    root.dataset['theme'] = THEMES[(THEMES.indexOf(show()) + 1) % THEMES.length] as string;
    try {
      localStorage.setItem('glanz theme', root.dataset['theme']);
    } catch {
      // Storage may be forbidden: the theme lasts as long as the page.
    }
    show();
  });
  show();
}
