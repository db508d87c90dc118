// What the colours of the drawing mean.

/** What the colours mean. */
function fillLegend(pane) {
  const legend = byId('legend'),
    isDark = pane.app.isDark();
  legend.replaceChildren();
  if (!pane.path) return;
  const entry = (colour, text) => {
    const spot = make('i');
    spot.style.background = colour;
    return make('span', {}, spot, text);
  };
  const colour = (i) => cssColour(colourOf(pane.mode, i, isDark));
  const most = 12;
  if (pane.mode === 'motion') {
    const used = new Set(pane.path.drawn.kinds);
    ['rapid', 'feed', 'cycle', 'thread'].forEach((name, i) => {
      if (used.has(i)) legend.append(entry(colour(i), name));
    });
  } else if (pane.mode === 'tool') {
    pane.path.tools
      .slice(0, most)
      .forEach((tool, i) => legend.append(entry(colour(i), toolName(tool))));
  } else if (pane.mode === 'operation') {
    const used = pane.path.json.operations
      .map((operation, i) => [operation, i])
      .filter(([, i]) => pane.app.measures.byOperation[i].moves > 0);
    for (const [operation, i] of used.slice(0, most))
      legend.append(entry(colour(i & 255), operationName(operation)));
    if (used.length > most) legend.append(make('span', {}, '…'));
  } else {
    const ramp = make('i', { className: 'ramp' });
    ramp.style.background = `linear-gradient(90deg, ${[0, 64, 128, 192, 255].map(colour).join(', ')})`;
    const [low, high] = pane.mode === 'feed' ? [0, pane.path.greatestFeed] : pane.heights();
    legend.append(
      make('span', {}, number(low), ramp, `${number(high)}${pane.mode === 'feed' ? ' (F)' : ' mm'}`)
    );
  }
  if (pane.path.centre)
    legend.append(
      entry(
        cssColour(colourOf('motion', 4, isDark)),
        pane.path.isLathe ? 'centre of the nose' : 'centre of the tool'
      )
    );
}
