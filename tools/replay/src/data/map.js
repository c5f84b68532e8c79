// A map of failure as the program writes it into the page: the cells of a slope's face, and what a batch found on them.

const kElement = "failure-map";

/** The map in the page, with the values of its cells by quantity; null in the page of a run. */
export function embeddedMap() {
  const text = document.getElementById(kElement)?.textContent;
  return text ? prepared(JSON.parse(text)) : null;
}

function prepared(map) {
  const { hits, volume } = map.cells;
  const probability = hits.map((count) => (map.runs > 0 ? count / map.runs : 0));
  return {
    ...map,
    heading: map.outlook ? Math.atan2(map.outlook[1], map.outlook[0]) : undefined,
    quantities: {
      probability: { ...map.scales.probability, values: probability },
      volume: { ...map.scales.volume, values: volume },
    },
  };
}
