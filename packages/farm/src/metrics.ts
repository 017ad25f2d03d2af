import type { FarmStatus } from './queue/status';

/** Labels in Prometheus' text format, version 0.0.4. */
const label = (text: string) => text.replace(/\\/g, '\\\\').replace(/"/g, '\\"').replace(/\n/g, '\\n');

/** The status of a farm in Prometheus' text format (`text/plain; version=0.0.4`). */
export function farmMetrics(status: FarmStatus, now = Date.now()): string {
  const lines: string[] = [];
  const metric = (
    name: string,
    type: 'gauge' | 'counter',
    help: string,
    values: readonly (readonly [labels: Readonly<Record<string, string>>, value: number])[],
  ) => {
    lines.push(`# HELP glanz_farm_${name} ${help}`, `# TYPE glanz_farm_${name} ${type}`);
    for (const [labels, value] of values) {
      const text = Object.entries(labels)
        .map(([key, content]) => `${key}="${label(content)}"`)
        .join(',');
      lines.push(`glanz_farm_${name}${text ? `{${text}}` : ''} ${value}`);
    }
  };
  const { waiting, active, delayed, failed, workers } = status;
  metric(
    'jobs',
    'gauge',
    'Jobs in the queue by state.',
    Object.entries({ waiting, active, delayed, failed }).map(([state, count]) => [{ state }, count]),
  );
  metric('jobs_done_total', 'counter', 'Jobs finished.', [[{}, status.done]]);
  metric(
    'retries_total',
    'counter',
    'Attempts that failed and were taken up again, by kind of failure.',
    Object.entries(status.retries).map(([kind, count]) => [{ kind }, count]),
  );
  metric('job_seconds_mean', 'gauge', 'Mean duration of a job in seconds.', [[{}, status.secondsPerJob]]);
  metric('workers', 'gauge', 'Workers with a recent heartbeat.', [[{}, workers.length]]);
  metric(
    'worker_jobs_done_total',
    'counter',
    'Jobs finished by a worker.',
    workers.map(({ id, gpu, done }) => [{ worker: id, gpu }, done]),
  );
  metric(
    'worker_heartbeat_age_seconds',
    'gauge',
    'Time since the last heartbeat of a worker.',
    workers.map(({ id, gpu, beat }) => [{ worker: id, gpu }, Math.max(0, now - beat) / 1000]),
  );
  return `${lines.join('\n')}\n`;
}
