// The raw-ink ONNX model in this browser, by onnxruntime-web: no server is asked anything but for the files of this page.

import * as ort from "onnxruntime-web/wasm";
import { answers, feeds, things, type Answer, type Drawn, type Recipe, type Thing } from "./feeds";

const MOST = 96; // strokes read together, the latest: time and memory grow as the square

export interface Read { answers: Answer[]; things: Thing[] }

export class InkModel {
  private constructor(private session: ort.InferenceSession, private recipe: Recipe) {}

  /** Loads the runtime and the model, which lie beside the page. */
  static async loaded(): Promise<InkModel> {
    ort.env.wasm.numThreads = 1; // more would need headers that a static host may not send
    ort.env.wasm.wasmPaths = { wasm: new URL("ort-wasm-simd-threaded.wasm", location.href) };
    const [session, recipe] = await Promise.all([
      ort.InferenceSession.create(new URL("strokes.onnx", location.href).href),
      fetch("strokes.json").then((answer) => answer.json() as Promise<Recipe>),
    ]);
    return new InkModel(session, recipe);
  }

  /** What the latest strokes are; `answers` is in step with their end. */
  async read(strokes: Drawn[]): Promise<Read> {
    const latest = strokes.slice(-MOST), given = feeds(latest);
    if (!latest.length) return { answers: [], things: [] };
    const found = await this.session.run({
      points: new ort.Tensor("float64", given.points, [given.points.length / 2, 2]),
      times: new ort.Tensor("float64", given.times, [given.times.length]),
      stroke: new ort.Tensor("int64", given.stroke, [given.stroke.length]),
      page: new ort.Tensor("int64", given.page, [given.page.length]),
      timed: new ort.Tensor("float32", given.timed, [given.timed.length]),
    });
    const numbers = (name: string): Float32Array => found[name]!.data as Float32Array;
    const all = answers(numbers("kinds"), numbers("strange"), this.recipe);
    const first = strokes.length - latest.length;
    return { answers: all, things: things(all, numbers("together")).map((one) => ({ ...one, strokes: one.strokes.map((k) => k + first) })) };
  }
}
