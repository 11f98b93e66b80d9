//! The errors behind the scores of a task, contact point by contact point.

use std::collections::BTreeMap;

use taceva_evaluate::EvaluationReport;

use crate::result::PointErrors;

/// The absolute errors of each channel, summed by contact point, or sample by sample where no contact point is known.
pub(super) fn errors(report: &EvaluationReport) -> Result<PointErrors, csv::Error> {
    let Some(samples) = &report.samples else {
        return Ok(BTreeMap::new());
    };
    let mut text = Vec::new();
    samples.write(&mut text, str::to_owned)?;
    let mut table = csv::Reader::from_reader(text.as_slice());
    let names: Vec<String> = table.headers()?.iter().map(str::to_owned).collect();
    let position = |name: &str| names.iter().position(|known| known == name);
    let channels: Vec<(&str, usize, usize)> = names
        .iter()
        .filter_map(|name| {
            let predicted = position(&format!("{name}_predicted"))?;
            Some((name.as_str(), position(name)?, predicted))
        })
        .collect();
    let point = position("point_id").or_else(|| position("id")).unwrap_or(0);
    let mut sums: BTreeMap<String, BTreeMap<String, (u64, f64)>> = BTreeMap::new();
    for record in table.records() {
        let record = record?;
        let number = |at: usize| {
            record
                .get(at)?
                .parse::<f64>()
                .ok()
                .filter(|value| value.is_finite())
        };
        for (channel, truth, predicted) in &channels {
            let (Some(truth), Some(predicted)) = (number(*truth), number(*predicted)) else {
                continue;
            };
            let of_channel = sums.entry((*channel).to_owned()).or_default();
            let cell = of_channel
                .entry(record.get(point).unwrap_or_default().to_owned())
                .or_default();
            cell.0 += 1;
            cell.1 += (truth - predicted).abs();
        }
    }
    let listed = |points: BTreeMap<String, (u64, f64)>| {
        let points = points.into_iter();
        points.map(|(point, (n, sum))| (point, n, sum)).collect()
    };
    Ok(sums
        .into_iter()
        .map(|(channel, points)| (channel, listed(points)))
        .collect())
}
