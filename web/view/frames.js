// Drawing at most once a frame.

/**
 * A function that asks for one drawing before the next frame, however often it is called until then.
 * @param {() => void} render
 */
export function oncePerFrame(render) {
  let asked = false;
  return () => {
    if (asked) return;
    asked = true;
    requestAnimationFrame(() => {
      asked = false;
      render();
    });
  };
}
