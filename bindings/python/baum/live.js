// SPDX-License-Identifier: BSD-3-Clause
// Lets a page of src/draw/page.html follow a run in progress: _server.py adds this script to the page.
// The server sends frames; the page appends them to its table, so that the time bar grows.
'use strict';
{
const MOST = 2400; // largest number of frames; when it is reached, every other frame is removed
let following = true, paused = false, touched = false, scale = view.scale, room = '';

table.forEach((column, c) => { table[c] = Array.from(column); });
times = table[0];
play = () => {}; // the page plays nothing: it shows the frames of the run as they arrive

const keep = (list, test) => list.filter((_, k) => test(k));
function thin(test) {
  table.forEach((column, c) => { table[c] = keep(column, test); });
  for (const trace of traces) trace.points = keep(trace.points, test);
  times = table[0];
}
function append(row) {
  if (row[0] === last) thin(k => k < times.length - 1);
  else if (row[0] < last) thin(() => false); // the time has gone back, so all frames are discarded
  if (times.length >= MOST) thin(k => k % 2 === 0);
  row.forEach((x, c) => table[c].push(x));
  const k = times.length - 1;
  traces.forEach((trace, i) => trace.points.push(moved(frame(bodies[trace.body], [k, k, 0]), data.traces[i].point)));
  data.frames = times.length;
  [first, last] = [times[0], times[k]];
  span = last - first || 1;
}
// The view is fitted again when a shape leaves it or the window changes, until the user moves or zooms the view.
const isOutside = ([x, y]) => x < 0 || x > wide || y < 0 || y > high;
function follow() {
  touched = touched || view.scale !== scale || view.shift.some(x => x !== 0);
  const frames = framesAt(at(last)), before = room;
  room = `${wide} ${high}`;
  const left = shape => shape.places.some(point => isOutside(project(moved(frames[shape.body], point))));
  if (!touched && (room !== before || shapes.some(left))) { fit(); scale = view.scale; }
}

const bar = find('play').parentNode;
function button(text, act) {
  const made = document.createElement('button');
  made.textContent = text;
  made.onclick = act;
  bar.insertBefore(made, find('now'));
  return made;
}
const send = what => fetch(what, {method: 'POST'}).catch(() => {});
const togglePause = () => send(paused ? 'resume' : 'pause');
const forward = () => following && paused ? send('step') : step(1);
function showNewest() { following = true; seek(last); label(); }
const one = button('Step', () => { showNewest(); send('step'); });
const newest = button('Newest', showNewest);
function label() {
  find('play').textContent = paused ? 'Run' : 'Pause';
  one.disabled = !paused;
  newest.hidden = following;
}
function lookBack() { following = now >= last; label(); }

find('play').onclick = togglePause;
find('fit').addEventListener('click', () => { touched = false; scale = view.scale; });
find('time').addEventListener('input', lookBack);
find('speed').parentNode.hidden = find('video').hidden = true;
Object.assign(KEYS, {' ': togglePause, End: showNewest, Home: () => { seek(first); lookBack(); },
  ArrowLeft: shift => { step(shift ? -10 : -1); lookBack(); }, ArrowRight: shift => { shift ? step(10) : forward(); lookBack(); }});
document.querySelector('.help').firstChild.data = 'The space bar pauses the run, the right arrow key steps, dragging ';

const source = new EventSource('events');
source.onmessage = event => {
  const {t, q, paused: held} = JSON.parse(event.data);
  append([t, ...q]);
  if (held !== paused) { paused = held; label(); }
  if (following) { now = last; follow(); }
  now = Math.max(now, first);
  redraw();
};
source.addEventListener('end', () => { // without close(), the browser would connect again
  source.close();
  find('play').disabled = one.disabled = true;
  find('play').textContent = 'Ended';
});
playing = false;
label();
}
