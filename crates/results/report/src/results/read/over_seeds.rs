//! Scores over the seeds of the training.

use super::super::{OverSeeds, ResultsError, SeedScore};
use super::place::Place;
use super::values::unit;

pub(super) fn over_seeds(place: &Place<'_>) -> Result<OverSeeds, ResultsError> {
    let seeds = place.entry("seeds")?.items()?;
    let scores = place.entry("scores")?.items()?;
    Ok(OverSeeds {
        seeds: seeds.iter().map(Place::count).collect::<Result<_, _>>()?,
        decides: place.entry("decides")?.text()?.to_owned(),
        scores: scores.iter().map(score).collect::<Result<_, _>>()?,
    })
}

fn score(place: &Place<'_>) -> Result<SeedScore, ResultsError> {
    let text = |key: &str| place.entry(key)?.text().map(str::to_owned);
    let values = place.entry("values")?.items()?;
    let ends = place.entry("interval")?;
    let [low, high] = &ends.items()?[..] else {
        return Err(ends.refuse("two numbers"));
    };
    Ok(SeedScore {
        metric: text("metric")?,
        channel: text("channel")?,
        unit: unit(&place.entry("unit")?)?,
        values: values
            .iter()
            .map(Place::optional_number)
            .collect::<Result<_, _>>()?,
        mean: place.entry("mean")?.number()?,
        standard_deviation: place.entry("standard_deviation")?.number()?,
        interval: [low.number()?, high.number()?],
    })
}
