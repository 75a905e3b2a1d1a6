// Ink as the arrays that the ONNX file takes (recognizer/learned/README.md), and its answers as claims. No DOM, no runtime.

import type { Point, StrokeKind } from "../wire/protocol";

export interface Drawn { points: Point[]; times: number[] }
/** What the file's own recipe says: the kinds in the order of its scores, and how strange is too strange. */
export interface Recipe { kinds: StrokeKind[]; reject_above: number }
export interface Answer { kind: StrokeKind; confidence: number; rejected: boolean; scores: [StrokeKind, number][] }
export interface Thing { strokes: number[]; kind: StrokeKind; confidence: number; rejected: boolean }

export interface Feeds {
  points: Float64Array; times: Float64Array; stroke: BigInt64Array; page: BigInt64Array; timed: Float32Array;
}

/** All strokes as one page, at least one; a page of one point is given it twice, as the file wants at least two. */
export function feeds(strokes: Drawn[]): Feeds {
  const whole = strokes.length === 1 && strokes[0]!.points.length === 1
    ? [{ points: [strokes[0]!.points[0]!, strokes[0]!.points[0]!], times: [strokes[0]!.times[0]!, strokes[0]!.times[0]!] }]
    : strokes;
  return {
    points: Float64Array.from(whole.flatMap((one) => one.points.flat())),
    times: Float64Array.from(whole.flatMap((one) => one.times)),
    stroke: BigInt64Array.from(whole.flatMap((one, k) => one.points.map(() => BigInt(k)))),
    page: new BigInt64Array(whole.length),
    timed: new Float32Array(whole.length).fill(1),
  };
}

/** What each stroke is: scores (strokes, kinds) row by row, strange (strokes). */
export function answers(scores: ArrayLike<number>, strange: ArrayLike<number>, recipe: Recipe): Answer[] {
  const { kinds } = recipe;
  return Array.from({ length: strange.length }, (_, k) => {
    const row = kinds.map((kind, n): [StrokeKind, number] => [kind, scores[k * kinds.length + n]!]).sort((a, b) => b[1] - a[1]);
    const [kind, confidence] = row[0]!;
    return { kind, confidence, rejected: strange[k]! > recipe.reject_above, scores: row };
  });
}

/** The strokes as things: those that are likelier of one thing than not, directly or through others; of each the kind
 * that its strokes think likeliest together. together (strokes, strokes) row by row. */
export function things(all: Answer[], together: ArrayLike<number>): Thing[] {
  const n = all.length, of = Array.from({ length: n }, (_, k) => k);
  for (let a = 0; a < n; a++) {
    for (let b = a + 1; b < n; b++) {
      const from = of[b]!, to = of[a]!;
      if (together[a * n + b]! > 0.5 && from !== to) of.forEach((one, k) => { if (one === from) of[k] = to; });
    }
  }
  return [...new Set(of)].map((root) => {
    const strokes = of.flatMap((one, k) => (one === root ? [k] : [])), sums = new Map<StrokeKind, number>();
    for (const k of strokes) for (const [kind, score] of all[k]!.scores) sums.set(kind, (sums.get(kind) ?? 0) + score / strokes.length);
    const [kind, confidence] = [...sums].sort((a, b) => b[1] - a[1])[0]!;
    return { strokes, kind, confidence, rejected: strokes.every((k) => all[k]!.rejected) };
  });
}
