export {
  estimated,
  timed,
  wallTimes,
  type Benchmark,
  type BenchmarkContext,
  type BenchmarkResult,
  type Figure,
} from './benchmark';
