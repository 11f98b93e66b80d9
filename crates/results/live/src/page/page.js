// Shows the state of the program, and sends the decisions of the person. The token follows # in the URL and is sent only in a header.
'use strict';
(() => {
  const token = location.hash.slice(1);
  const find = (id) => document.getElementById(id);
  const headers = { 'X-Taceva-Token': token };
  let question = null;
  let isOver = false;
  let drawnAt = null;

  const say = (words) => {
    find('lost').hidden = !words;
    find('lost').textContent = words;
  };

  const refusals = {
    401: 'This address has no token or an old one: open the whole address that the program printed, including the part after #.',
    503: 'Two pages are already open: close one. Stop still works here.',
  };

  const post = async (path, body) => {
    const answer = await fetch(path, { method: 'POST', headers, body });
    if (!answer.ok && answer.status !== 409) {
      throw new Error(refusals[answer.status] || `the program answered ${answer.status}`);
    }
  };

  const number = (value, digits, unit) => (value === null || value === undefined ? '–' : `${value.toFixed(digits)}${unit}`);

  const gauge = (id, value, most, unit, digits) => {
    const box = find(id);
    box.hidden = value === null && most === null;
    box.querySelector('.number').textContent = number(value, digits, ` ${unit}`);
    const share = value === null || !most ? 0 : Math.max(0, value / most);
    box.querySelector('.bar i').style.width = `${Math.min(1, share) * 100}%`;
    box.querySelector('.bar').hidden = !most;
    box.querySelector('.limit').textContent = most ? `limit ${most.toFixed(digits)} ${unit}` : '';
    box.classList.toggle('near', share > 0.8 && share <= 1);
    box.classList.toggle('over', share > 1);
  };

  const ask = (asked) => {
    const next = asked ? asked.number : null;
    if (next === question) return;
    question = next;
    find('question').hidden = !asked;
    for (const id of ['done', 'skip', 'end']) find(id).disabled = false;
    find('picture').replaceChildren();
    if (!asked) return;
    find('asked').textContent = asked.text;
    find('done').textContent = asked.done;
    find('skip').hidden = !asked.can_skip;
    if (asked.picture) {
      const drawn = new DOMParser().parseFromString(asked.picture, 'image/svg+xml').documentElement;
      find('picture').append(document.importNode(drawn, true));
    }
    // Never focus the button: a stray key must not confirm that hands are out of reach.
    find('question').focus({ preventScroll: true });
  };

  const show = (state) => {
    document.title = state.question ? `Your turn · ${state.title}` : state.title;
    find('title').textContent = state.title;
    find('stage').textContent = state.ended || (state.is_stopping ? 'stopping; press again to halt at once' : state.stage);
    gauge('normal', state.Fz_N, state.limits.Fz_max_N, 'N', 2);
    gauge('shear', state.Fxy_N, state.limits.Fxy_max_N, 'N', 2);
    gauge('depth', state.Pz_mm, state.limits.Pz_max_mm, 'mm', 3);
    find('forces').hidden = ['normal', 'shear', 'depth'].every((id) => find(id).hidden);
    // During presses the camera is read at rests only: an older picture does not belong to the present force.
    const age = drawnAt === null ? 0 : (performance.now() - drawnAt) / 1000;
    find('age').hidden = age < 1;
    find('age').textContent = `picture taken ${age.toFixed(0)} s ago`;
    find('frames').textContent = `${state.frames} · ${state.rate_hz.toFixed(1)} Hz`;
    const lost = state.dropped + state.damaged;
    find('drops').textContent = state.numbered ? `${lost}` : `${lost} or more`;
    find('drops').classList.toggle('bad', lost > 0);
    find('saturated').textContent = state.saturated === null ? '–' : `${(state.saturated * 100).toFixed(1)} %`;
    find('saturated').classList.toggle('bad', state.saturated > 0.02);
    find('sharpness').textContent = number(state.sharpness, 0, '');
    find('by').textContent = state.predicted_by ? `predicted by ${state.predicted_by}, not measured` : 'predicted, not measured';
    const frames = state.predicted;
    find('left-out-fact').hidden = !frames;
    find('outside-fact').hidden = !frames || frames.outside === null;
    if (frames) {
      const predicted = Math.max(1, frames.seen - frames.dropped);
      find('left-out').textContent = `${frames.dropped} of ${frames.seen}`;
      find('outside-share').textContent = frames.outside === null ? '–' : `${((100 * frames.outside) / predicted).toFixed(1)} %`;
    }
    find('presses').textContent = `${state.presses[0]} of ${state.presses[1]}`;
    find('stop').disabled = Boolean(state.ended);
    find('stop').textContent = state.is_stopping && !state.ended ? 'Halt here' : 'Stop';
    ask(state.ended ? null : state.question);
    if (state.ended) isOver = true;
  };

  const svg = (name, attributes) => {
    const element = document.createElementNS('http://www.w3.org/2000/svg', name);
    for (const [key, value] of Object.entries(attributes)) element.setAttribute(key, value);
    return element;
  };

  const map = (places) => {
    find('places').hidden = places.length === 0;
    if (places.length === 0) return;
    const reach = Math.max(1, ...places.map((place) => Math.max(Math.abs(place.x_mm), Math.abs(place.y_mm)))) * 1.12;
    const rank = ['open', 'skipped', 'done', 'short', 'now'];
    // The latest press of a place is drawn on top.
    const sorted = places.slice().sort((one, other) => rank.indexOf(one.state) - rank.indexOf(other.state));
    find('map').setAttribute('viewBox', `${-reach} ${-reach} ${2 * reach} ${2 * reach}`);
    const dots = sorted.map((place) => svg('circle', {
      cx: place.x_mm, cy: -place.y_mm, r: reach * (place.state === 'now' ? 0.045 : 0.028), class: place.state,
    }));
    find('map').replaceChildren(...dots);
  };

  // Reads a stream, and reconnects until the run has ended. A hidden page drops its pictures.
  const follow = async (path, read, isWanted) => {
    for (;;) {
      if (isOver) return;
      try {
        if (isWanted()) {
          const answer = await fetch(path, { headers, cache: 'no-store' });
          if (!answer.ok) throw new Error(refusals[answer.status] || `the program answered ${answer.status}`);
          say('');
          await read(answer.body.getReader(), isWanted);
        }
      } catch (error) {
        if (!isOver) say(error instanceof TypeError ? 'The program does not answer: it has ended, or this machine is busy.' : error.message);
      }
      await new Promise((done) => setTimeout(done, 700));
    }
  };

  const events = async (reader) => {
    const decoder = new TextDecoder();
    let waiting = '';
    for (;;) {
      const { value, done } = await reader.read();
      if (done) return;
      waiting += decoder.decode(value, { stream: true });
      const parts = waiting.split('\n\n');
      waiting = parts.pop();
      for (const part of parts) {
        const [kind, text] = part.split('\n');
        const said = JSON.parse(text.slice('data: '.length));
        if (kind === 'event: places') map(said); else show(said);
      }
    }
  };

  // Prediction for the shown picture, marked as a prediction.
  const predict = (said) => {
    find('predicted').hidden = !said;
    if (!said) return;
    const digits = { N: 2, mm: 3 };
    const rows = said.values.map((value) => {
      const row = document.createElement('div');
      const [name, text] = [document.createElement('dt'), document.createElement('dd')];
      name.textContent = value.channel;
      text.textContent = number(value.value, digits[value.unit] ?? 3, value.unit === '1' ? '' : ` ${value.unit}`);
      row.append(name, text);
      return row;
    });
    find('values').replaceChildren(...rows);
    find('outside').hidden = !said.outside;
    find('predicted').classList.toggle('outside', Boolean(said.outside));
    find('outside').textContent = said.outside ? `unlike the training pictures: distance ${number(said.distance, 1, '')}, limit 1` : '';
  };

  const draw = async (bytes, said) => {
    const picture = await createImageBitmap(new Blob([bytes], { type: 'image/jpeg' }));
    const canvas = find('frame');
    if (canvas.width !== picture.width || canvas.height !== picture.height) {
      canvas.width = picture.width;
      canvas.height = picture.height;
    }
    canvas.getContext('2d').drawImage(picture, 0, 0);
    picture.close();
    drawnAt = performance.now();
    predict(said);
    find('waiting').hidden = true;
  };

  // End of the head of a part: after an empty line.
  const headEnd = (bytes) => {
    for (let at = 0; at + 3 < bytes.length; at += 1) {
      if (bytes[at] === 13 && bytes[at + 1] === 10 && bytes[at + 2] === 13 && bytes[at + 3] === 10) return at + 4;
    }
    return -1;
  };

  const frames = async (reader, isWanted) => {
    const decoder = new TextDecoder('latin1');
    let waiting = new Uint8Array(0);
    for (;;) {
      const { value, done } = await reader.read();
      if (done) return;
      if (!isWanted()) {
        await reader.cancel();
        return;
      }
      const joined = new Uint8Array(waiting.length + value.length);
      joined.set(waiting);
      joined.set(value, waiting.length);
      waiting = joined;
      for (;;) {
        while (waiting[0] === 13 || waiting[0] === 10) waiting = waiting.subarray(1);
        const begins = headEnd(waiting);
        if (begins < 0) break;
        const head = decoder.decode(waiting.subarray(0, begins));
        const length = Number(/content-length: (\d+)/i.exec(head)[1]);
        const said = /^x-taceva-prediction: (.*)$/im.exec(head);
        if (waiting.length < begins + length) break;
        const bytes = waiting.slice(begins, begins + length);
        waiting = waiting.slice(begins + length);
        await draw(bytes, said && JSON.parse(said[1]));
      }
    }
  };

  find('stop').addEventListener('click', () => {
    post('/stop').catch((error) => say(`Stop did not reach the program: ${error.message}. Use the emergency stop.`));
  });
  for (const [id, answer] of [['done', 'done'], ['skip', 'skip'], ['end', 'stop']]) {
    find(id).addEventListener('click', () => {
      for (const other of ['done', 'skip', 'end']) find(other).disabled = true;
      post('/answer', JSON.stringify({ question, answer })).catch((error) => {
        for (const other of ['done', 'skip', 'end']) find(other).disabled = false;
        say(error.message);
      });
    });
  }
  follow('/events', events, () => true);
  follow('/frames', frames, () => !document.hidden);
})();
