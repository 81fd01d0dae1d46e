// Rows that a person puts into another order: dragged by a finger or a mouse, or moved by the arrow keys.

export const moved = (list, from, to) => {
  const next = list.filter((_, index) => index !== from);
  next.splice(to, 0, list[from]);
  return next;
};

/** A row is grabbed. `rows` gives the elements, in the order of `list`. `show` is called with each order on the way, and
    the row that is dragged, null once it is let go; `done` with the last order, where it is another one. */
export function drag(event, rows, list, from, show, done) {
  if (event.button > 0) return;
  event.preventDefault();
  event.currentTarget.focus({ preventScroll: true });
  const one = list[from];
  let order = list;
  const move = (to) => {
    const over = rows().findIndex((row) => to.clientY < row.getBoundingClientRect().bottom), next = over < 0 ? list.length - 1 : over;
    if (next !== order.indexOf(one)) order = moved(order, order.indexOf(one), next);
    show(order, one);
  };
  const end = (to) => {
    removeEventListener("pointermove", move);
    ["pointerup", "pointercancel"].forEach((each) => removeEventListener(each, end));
    const kept = to.type !== "pointercancel" && order.indexOf(one) !== from;
    show(kept ? order : list, null);
    if (kept) done(order, order.indexOf(one));
  };
  addEventListener("pointermove", move);
  ["pointerup", "pointercancel"].forEach((each) => addEventListener(each, end));
}

/** The arrow keys on a handle. `place` is called with where the row goes. */
export function keyed(event, from, count, place) {
  const to = from + ({ ArrowUp: -1, ArrowDown: 1 }[event.key] ?? NaN);
  if (Number.isNaN(to)) return;
  event.preventDefault();
  if (to >= 0 && to < count) place(to);
}
