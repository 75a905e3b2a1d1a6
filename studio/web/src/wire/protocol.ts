// What the server says. Page units, y down; times in seconds. Mirrors studio/view.py, studio/session.py and studio/link.py.

export type Point = [number, number];
export type StrokeKind =
  "circle" | "polygon" | "spring" | "wire" | "arrow" | "tap" | "scribble" | "lasso" | "math";

export type Shape =
  | { kind: "circle"; centre: Point; radius: number }
  | { kind: "polygon"; vertices: Point[] }
  | { kind: "spring"; start: Point; end: Point; coils: number; width: number }
  | { kind: "wire"; start: Point; end: Point }
  | { kind: "arrow"; start: Point; end: Point };

export interface Component {
  label: string;
  kind: Shape["kind"];
  fixed: boolean;
  ends: [string | null, string | null];
  drawn: Shape;
  shape: Shape;
  strokes: string[];
}

export interface Line {
  line: number;
  text: string | null;
  mathml: string | null;
  problem: string | null;
  at: Point | null;
  strokes: string[];
  confidence: number;
  alternatives: string[];
}

/** A line that is being written, as it reads now. line: the page's line whose ink it is; sure: Analyze would take it. */
export interface LiveLine {
  strokes: string[]; line: number | null; text: string; mathml: string | null; sure: boolean; confidence: number; alternatives: string[];
}

export interface Association { line: number; component: string; anchor: Point }
export interface Correction { rule: string; component: string; made: boolean; why: string[]; labels: string[] }
export interface Verdict {
  line: number; component: string; text: string; status: "right" | "wrong" | "not determined";
  given: number | null; true: number | null; unit: string; error: number | null;
  misconception: string | null; dimensions: string | null; converted: string | null; message: string;
}
export interface PlacedStroke { id: string; dx: number; dy: number; kind: StrokeKind | null }
export interface InkStroke { id: string; points: Point[]; pressure: number[] | null; pointer: string }

export interface State {
  type: "state";
  page: string; seq: number; title: string; name: string; analyzed: boolean; loose: number;
  strokes: PlacedStroke[]; components: Component[]; lines: Line[]; associations: Association[];
  corrections: Correction[]; notices: string[];
  selected: { strokes: string[]; components: string[]; lines: number[] };
  undo: string | null; redo: string | null; next: string;
}

export interface Body { label: string; kind: string; mass: number; radius?: number; vertices?: Point[] }
export interface RunHead {
  type: "run"; run: number; seconds: number; rate: number; bodies: Body[]; links: string[];
  perMetre: number; notices: string[];
}
export interface Happening { time: number; kind: string; bodies: string[]; message: string; speed: number | null }
export interface Claim {
  id: string; kind: StrokeKind; confidence: number; rejected: boolean; scores: Record<string, number>;
}
export interface Reading {
  type: "reading"; name: string; about: string; claims: Claim[]; lines: number;
  components: { label: string; kind: Shape["kind"]; fixed: boolean; shape: Shape }[];
  run: RunHead | null; events?: Happening[]; rows: number; columns: number;
}

export interface Drawn {
  type: "drawn"; id: string; stroke?: InkStroke; seq: number; undo: string | null; redo: string | null;
  next: string; loose: number; name: string;
}

export type Told =
  | State
  | RunHead
  | { type: "status"; ready: boolean }
  | { type: "strokes"; strokes: InkStroke[] }
  | Drawn
  | { type: "live"; lines: LiveLine[] }
  | { type: "ack"; key: string; said: "drawn" | "lasso" | "scribble" | "tap" | "done"; words: string; seq: number }
  | { type: "verdicts"; seq: number; verdicts: Verdict[] }
  | { type: "end"; run: number; seconds: number; asked: number; told: string[]; observable: Record<string, string[]> }
  | { type: "error"; key: string | null; run?: number; message: string }
  | { type: "pong" };

export type Packed =
  | { type: "piece"; run: number; rows: number; columns: number; events: Happening[] }
  | { type: "series"; run: number; body: string; quantity: string; unit: string; vector: boolean; rows: number }
  | Reading;
