// What the front end's unit tests need of node, declared here: its types are no dependency for that little.
// @ts-ignore
import assertion from "node:assert/strict";
// @ts-ignore
import { test as nodeTest } from "node:test";

export const assert = assertion as {
  equal(a: unknown, b: unknown, why?: string): void;
  deepEqual(a: unknown, b: unknown, why?: string): void;
  ok(value: unknown, why?: string): void;
  throws(act: () => unknown, kind?: unknown): void;
};
export const test = nodeTest as (name: string, act: () => void) => void;
export const near = (a: number, b: number, by = 1e-9): void => assert.ok(Math.abs(a - b) <= by, `${a} is not ${b}`);
