import { test as base, type PlaywrightTestOptions } from '@playwright/test';

/** Options that do not describe the context, and the viewport, which each page can change. */
type Other = 'viewport' | 'actionTimeout' | 'navigationTimeout' | 'testIdAttribute';

/** Playwright's `test` with what `test.use` says of a test's context. */
export const test = base.extend<{
  /** Options of the test's context without the viewport: equal texts for contexts that can be shared. */
  contextKey: string;
}>({
  contextKey: async (
    {
      acceptDownloads,
      baseURL,
      bypassCSP,
      clientCertificates,
      colorScheme,
      contextOptions,
      contrast,
      deviceScaleFactor,
      extraHTTPHeaders,
      forcedColors,
      geolocation,
      hasTouch,
      httpCredentials,
      ignoreHTTPSErrors,
      isMobile,
      javaScriptEnabled,
      locale,
      offline,
      permissions,
      proxy,
      reducedMotion,
      screen,
      serviceWorkers,
      storageState,
      timezoneId,
      userAgent,
    },
    use,
  ) => {
    // The type has an error where an option is missing.
    const options: Record<Exclude<keyof PlaywrightTestOptions, Other>, unknown> = {
      acceptDownloads,
      baseURL,
      bypassCSP,
      clientCertificates,
      colorScheme,
      contextOptions,
      contrast,
      deviceScaleFactor,
      extraHTTPHeaders,
      forcedColors,
      geolocation,
      hasTouch,
      httpCredentials,
      ignoreHTTPSErrors,
      isMobile,
      javaScriptEnabled,
      locale,
      offline,
      permissions,
      proxy,
      reducedMotion,
      screen,
      serviceWorkers,
      storageState,
      timezoneId,
      userAgent,
    };
    await use(JSON.stringify(options));
  },
});
