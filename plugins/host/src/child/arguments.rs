//! Driver arguments as the child reads them.

use taceva_core::{ArgSpec, ArgValue, Args, ErrorKind};

use super::wire::Failure;

/// Rebuilds the arguments that the host has checked. The type of each value determines its declaration.
pub(super) fn arguments(pairs: &[(String, ArgValue)]) -> Result<Args, Failure> {
    let specs: Vec<ArgSpec> = pairs
        .iter()
        .map(|(key, value)| match value {
            ArgValue::Whole(_) => ArgSpec::whole(key, i64::MIN, i64::MAX),
            ArgValue::Number(_) => ArgSpec::number(key, f64::NEG_INFINITY, f64::INFINITY),
            ArgValue::Flag(_) => ArgSpec::flag(key),
            // Text; no other kind arrives, see `wire/value.rs`.
            _ => ArgSpec::text(key),
        })
        .collect();
    let texts = pairs.iter().map(|(key, value)| (key, value.to_string()));
    Args::from_pairs(&specs, texts).map_err(|error| {
        Failure::new(
            ErrorKind::InvalidArgument,
            "read the arguments",
            &error.to_string(),
        )
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn arguments_arrive_as_they_were_whatever_they_are() {
        let pairs = [
            ("depth".to_owned(), ArgValue::Number(0.1 + 0.2)),
            ("fast".to_owned(), ArgValue::Flag(false)),
            ("seed".to_owned(), ArgValue::Whole(i64::MIN)),
            ("table".to_owned(), ArgValue::Text(" a;b = 1\n".to_owned())),
        ];
        let args = arguments(&pairs).expect("sound");
        for (key, value) in &pairs {
            assert_eq!(args.get(key), Some(value));
        }
    }
}
