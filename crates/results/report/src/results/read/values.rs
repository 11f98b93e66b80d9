//! Scores, values and intervals.

use taceva_core::Unit;
use taceva_core::shown;
use taceva_metrics::{Band, Curve, Flag, Map, Matrix, Standing};

use super::super::{Interval, ResultsError, Score, Value, Variant};
use super::place::Place;

/// Keys of a score that are no variants.
const OWN: [&str; 25] = [
    "value",
    "unit",
    "undefined",
    "not_applicable",
    "of",
    "n",
    "n_invalid",
    "ci95",
    "method",
    "standard_error",
    "clusters",
    "degrees_of_freedom",
    "definition",
    "parameters",
    "counts",
    "flags",
    "standing",
    "bounded_share",
    "x",
    "x_unit",
    "x_mm",
    "y_mm",
    "values",
    "rows",
    "columns",
];

pub(super) fn score(metric: &str, channel: &str, place: &Place<'_>) -> Result<Score, ResultsError> {
    let (value, unit) = value(place)?;
    let count = |key: &str| place.optional(key).map_or(Ok(0), |place| place.count());
    let named = |key: &str| {
        place
            .optional(key)
            .map_or(Ok(Vec::new()), |at| at.entries())
    };
    let texts = |key: &str| -> Result<Vec<String>, ResultsError> {
        let items = place
            .optional(key)
            .map_or(Ok(Vec::new()), |at| at.items())?;
        items.iter().map(|at| Ok(at.text()?.to_owned())).collect()
    };
    let mut variants = Vec::new();
    for (name, at) in place.entries()? {
        if !OWN.contains(&name) && at.json().entries().is_some() {
            let (value, unit) = self::value(&at)?;
            variants.push(Variant {
                name: name.to_owned(),
                value,
                unit,
                interval: interval(&at)?,
            });
        }
    }
    let flags = texts("flags")?;
    let said = match place.optional("standing") {
        Some(at) => standing(&at)?,
        None => Standing::Counts,
    };
    Ok(Score {
        metric: metric.to_owned(),
        channel: channel.to_owned(),
        value,
        unit,
        n: count("n")?,
        n_invalid: count("n_invalid")?,
        interval: interval(place)?,
        definition: match place.optional("definition") {
            Some(at) => at.text()?.to_owned(),
            None => String::new(),
        },
        parameters: named("parameters")?
            .iter()
            .map(|(name, at)| Ok(((*name).to_owned(), at.number()?)))
            .collect::<Result<_, ResultsError>>()?,
        counts: named("counts")?
            .iter()
            .map(|(name, at)| Ok(((*name).to_owned(), at.count()?)))
            .collect::<Result<_, ResultsError>>()?,
        standing: said.max(of_flags(&flags)),
        flags,
        bounded_share: place
            .optional("bounded_share")
            .map(|at| at.number())
            .transpose()?,
        of: texts("of")?,
        variants,
    })
}

/// The standing that flags say: results of before `low stimulus` was one have the flag alone.
fn of_flags(flags: &[String]) -> Standing {
    match flags.contains(&Flag::LowStimulus.to_string()) {
        true => Standing::LowStimulus,
        false => Standing::Counts,
    }
}

fn standing(place: &Place<'_>) -> Result<Standing, ResultsError> {
    let words = place.text()?;
    Standing::from_words(words).ok_or_else(|| {
        place.refuse_found(
            "`skill unknown`, `bounded`, `low stimulus`, `not above the constant`, `skill not known: no interval` or `no skill`",
            format!("`{}`", words.escape_debug()),
        )
    })
}

fn value(place: &Place<'_>) -> Result<(Value, Unit), ResultsError> {
    for (key, wrap) in [
        ("undefined", Value::Undefined as fn(String) -> Value),
        ("not_applicable", Value::NotApplicable),
    ] {
        if let Some(reason) = place.optional(key) {
            return Ok((wrap(reason.text()?.to_owned()), Unit::One));
        }
    }
    let unit = unit(&place.entry("unit")?)?;
    let value = if let Some(number) = place.optional("value") {
        Value::Number(number.number()?)
    } else if place.optional("x_mm").is_some() {
        Value::Map(map(place)?)
    } else if place.optional("x").is_some() {
        Value::Curve(curve(place)?)
    } else if place.optional("rows").is_some() {
        Value::Matrix(matrix(place)?)
    } else {
        return Err(place.refuse_found(
            "a value, a map, a curve, a matrix or a reason",
            "none of them".to_owned(),
        ));
    };
    Ok((value, unit))
}

pub(super) fn unit(place: &Place<'_>) -> Result<Unit, ResultsError> {
    let symbol = place.text()?;
    Unit::from_symbol(symbol)
        .ok_or_else(|| place.refuse_found("a unit", format!("`{}`", shown(symbol))))
}

fn interval(place: &Place<'_>) -> Result<Option<Interval>, ResultsError> {
    let Some(ci95) = place.optional("ci95") else {
        return Ok(None);
    };
    if let Some(reason) = ci95.optional("undefined") {
        return Ok(Some(Interval::Absent(reason.text()?.to_owned())));
    }
    let ends = numbers(&ci95)?;
    let ends: [f64; 2] = ends
        .try_into()
        .map_err(|ends: Vec<f64>| ci95.refuse_found("two ends", format!("{}", ends.len())))?;
    let method = match place.optional("method") {
        Some(method) => method.text()?.to_owned(),
        None => "unstated".to_owned(),
    };
    let standard_error = place.optional("standard_error");
    let clusters = place.optional("clusters");
    let freedom = place.optional("degrees_of_freedom");
    Ok(Some(Interval::Ends {
        ends,
        method,
        standard_error: standard_error.map(|at| at.number()).transpose()?,
        clusters: clusters.map(|at| at.count()).transpose()?,
        degrees_of_freedom: freedom.map(|at| at.number()).transpose()?,
    }))
}

fn map(place: &Place<'_>) -> Result<Map, ResultsError> {
    let map = Map::new(
        numbers(&place.entry("x_mm")?)?,
        numbers(&place.entry("y_mm")?)?,
        grid(&place.entry("values")?)?,
        place
            .entry("counts")?
            .items()?
            .iter()
            .map(counts)
            .collect::<Result<_, _>>()?,
    );
    let fits = |rows: &[usize]| {
        let columns = |columns: &usize| columns + 1 == map.x_mm.len();
        rows.len() + 1 == map.y_mm.len() && rows.iter().all(columns)
    };
    let of_values: Vec<usize> = map.values.iter().map(Vec::len).collect();
    let of_counts: Vec<usize> = map.counts.iter().map(Vec::len).collect();
    match fits(&of_values) && fits(&of_counts) {
        true => Ok(map),
        false => Err(shape(place)),
    }
}

fn curve(place: &Place<'_>) -> Result<Curve, ResultsError> {
    let band = match place.optional("low") {
        Some(low) => Some(Band {
            low: optional_numbers(&low)?,
            high: optional_numbers(&place.entry("high")?)?,
        }),
        None => None,
    };
    let curve = Curve::new(
        numbers(&place.entry("x")?)?,
        unit(&place.entry("x_unit")?)?,
        optional_numbers(&place.entry("values")?)?,
        counts(&place.entry("counts")?)?,
    )
    .with_band(band);
    let levels = curve.x.len();
    let band_fits = curve
        .band
        .as_ref()
        .is_none_or(|band| band.low.len() == levels && band.high.len() == levels);
    match curve.values.len() == levels && curve.counts.len() == levels && band_fits {
        true => Ok(curve),
        false => Err(shape(place)),
    }
}

fn matrix(place: &Place<'_>) -> Result<Matrix, ResultsError> {
    let names = |key: &str| -> Result<Vec<String>, ResultsError> {
        let items = place.entry(key)?.items()?;
        items.iter().map(|at| Ok(at.text()?.to_owned())).collect()
    };
    let matrix = Matrix::new(
        names("rows")?,
        names("columns")?,
        grid(&place.entry("values")?)?,
    );
    let columns = matrix.columns.len();
    match matrix.values.len() == matrix.rows.len()
        && matrix.values.iter().all(|row| row.len() == columns)
    {
        true => Ok(matrix),
        false => Err(shape(place)),
    }
}

fn shape(place: &Place<'_>) -> ResultsError {
    place.refuse_found(
        "as many values as there are places for them",
        "another number".to_owned(),
    )
}

fn numbers(place: &Place<'_>) -> Result<Vec<f64>, ResultsError> {
    place.items()?.iter().map(Place::number).collect()
}

fn optional_numbers(place: &Place<'_>) -> Result<Vec<Option<f64>>, ResultsError> {
    place.items()?.iter().map(Place::optional_number).collect()
}

fn counts(place: &Place<'_>) -> Result<Vec<u64>, ResultsError> {
    place.items()?.iter().map(Place::count).collect()
}

fn grid(place: &Place<'_>) -> Result<Vec<Vec<Option<f64>>>, ResultsError> {
    place.items()?.iter().map(optional_numbers).collect()
}
