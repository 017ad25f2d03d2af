/** Milliseconds as people say them: `12 s`, `3 min 5 s`, `2 h 10 min`. */
export function spokenTime(milliseconds: number): string {
  const seconds = Math.ceil(milliseconds / 1000);
  if (!Number.isFinite(seconds)) return '…';
  if (seconds < 60) return `${seconds} s`;
  if (seconds < 3600) return `${Math.floor(seconds / 60)} min ${seconds % 60} s`;
  return `${Math.floor(seconds / 3600)} h ${Math.floor((seconds % 3600) / 60)} min`;
}

/** Samples per second with as many digits as it deserves. */
export const spokenRate = (rate: number): string => `${rate >= 100 ? Math.round(rate) : rate.toPrecision(2)} samples/s`;
