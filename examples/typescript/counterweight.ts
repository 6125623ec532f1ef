// What generators of clients leave out: retries, idempotency, jobs and their events. Types are those of the generator:
//   npx openapi-typescript http://127.0.0.1:8000/openapi.json -o schema.d.ts --default-non-nullable=false
import type { paths } from "./schema.d.ts";

type Posted<P extends keyof paths> = paths[P] extends { post: infer Operation } ? Operation : never;
export type Body<P extends keyof paths> = Posted<P> extends
  { requestBody: { content: { "application/json": infer T } } } ? T : never;
export type Answer<P extends keyof paths> = Posted<P> extends
  { responses: { 200: { content: { "application/json": infer T } } } } ? T : never;
export interface Job {
  id: string;
  state: "queued" | "running" | "done" | "failed" | "cancelled";
  links: Record<string, string>;
}

/** The service answered with an error; `fields` has the message of each wrong field by its JSON pointer. */
export class Refused extends Error {
  fields: Record<string, string>;
  constructor(public status: number, problem: { title?: string; errors?: { pointer: string; message: string }[] }) {
    super(`${status} ${problem.title ?? ""}`);
    this.fields = Object.fromEntries((problem.errors ?? []).map((one) => [one.pointer, one.message]));
  }
}

const pause = (ms: number) => new Promise((resume) => setTimeout(resume, ms));

export class Service {
  constructor(private url = "http://127.0.0.1:8000", private key?: string, private patienceMs = 60_000) {}

  /** An answer at once. Computations change nothing, so that a call that was cut off is simply sent again. */
  async post<P extends keyof paths & string>(path: P, body: Body<P>): Promise<Answer<P>> {
    return await (await this.send(path, body)).json();
  }

  /** A job: the key makes it the same job however often the call has to be sent. */
  async later(path: keyof paths & string, body: unknown): Promise<Job> {
    const headers = { Prefer: "respond-async", "Idempotency-Key": crypto.randomUUID() };
    return await (await this.send(path, body, headers)).json();
  }

  /** The states of a job up to its end; a stream that is cut goes on after the last event that arrived. */
  async *events(job: Job): AsyncGenerator<Job> {
    let last = "";
    for (let state = job; ["queued", "running"].includes(state.state);) {
      const stream = await this.send(`${job.links.self}/events`, undefined, last ? { "Last-Event-ID": last } : {});
      try {
        for await (const line of lines(stream)) {
          if (line.startsWith("id:")) last = line.slice(3).trim();
          if (line.startsWith("data:")) yield (state = JSON.parse(line.slice(5)));
        }
      } catch {
        await pause(500);
      }
    }
  }

  /** The answer of a job, once it is there. */
  async result<T>(job: Job): Promise<T> {
    let state = job;
    for await (state of this.events(job));
    if (state.state !== "done") throw new Error(`job ${job.id} is ${state.state}`);
    return await (await this.send(job.links.results)).json();
  }

  /** The rows of a sweep, one after the other. */
  async *rows(job: Job): AsyncGenerator<Record<string, unknown>> {
    for await (const line of lines(await this.send(`${job.links.results}?format=ndjson`))) yield JSON.parse(line);
  }

  async send(path: string, body?: unknown, more: Record<string, string> = {}): Promise<Response> {
    const until = Date.now() + this.patienceMs;
    const headers = { ...more, ...(this.key ? { Authorization: `Bearer ${this.key}` } : {}) };
    const posted = { method: "POST", body: JSON.stringify(body), headers: { "Content-Type": "application/json", ...headers } };
    for (let wait = 250;; wait = Math.min(2 * wait, 8000)) {
      const response = await fetch(this.url + path, body === undefined ? { headers } : posted).catch(() => null);
      if (response?.ok) return response;
      const asked = Number(response?.headers.get("Retry-After")) * 1000;
      if (response && !(asked > 0 && [429, 503].includes(response.status))) {
        throw new Refused(response.status, await response.json().catch(() => ({})));
      }
      if (Date.now() + (asked || wait) > until) throw new Error(`${this.url} does not answer`);
      await pause(asked || wait);
    }
  }
}

async function* lines(response: Response): AsyncGenerator<string> {
  let rest = "";
  const decoder = new TextDecoder();
  for await (const piece of response.body as unknown as AsyncIterable<Uint8Array>) {
    const found = (rest + decoder.decode(piece, { stream: true })).split("\n");
    rest = found.pop() ?? "";
    yield* found.filter((line) => line.trim());
  }
}
