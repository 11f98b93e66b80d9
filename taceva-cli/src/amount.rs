//! Numbers of bytes and durations as text.

use std::time::Duration;

/// Size as text, `1.5 GB`, with three digits and a decimal unit.
pub(crate) fn bytes(count: u64) -> String {
    let units = ["kB", "MB", "GB", "TB"];
    if count < 1000 {
        return format!("{count} B");
    }
    let mut number = count as f64 / 1e3;
    let mut unit = 0;
    while number >= 999.5 && unit + 1 < units.len() {
        number /= 1e3;
        unit += 1;
    }
    let decimals = if number < 9.995 {
        2
    } else {
        usize::from(number < 99.95)
    };
    format!("{number:.decimals$} {}", units[unit])
}

/// Age as text with one unit: `3 days`, `5 h`, `2 min`, `40 s`.
pub(crate) fn age(time: Duration) -> String {
    let seconds = time.as_secs();
    match seconds {
        0..=119 => format!("{seconds} s"),
        120..=7199 => format!("{} min", seconds / 60),
        7200..=172_799 => format!("{} h", seconds / 3600),
        _ => format!("{} days", seconds / 86_400),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn three_digits_of_bytes_are_enough() {
        let shown = [
            0,
            999,
            1000,
            9994,
            9995,
            99_949,
            571_000_000,
            999_499,
            999_500,
            u64::MAX,
        ]
        .map(bytes);
        assert_eq!(
            shown,
            [
                "0 B",
                "999 B",
                "1.00 kB",
                "9.99 kB",
                "10.0 kB",
                "99.9 kB",
                "571 MB",
                "999 kB",
                "1.00 MB",
                "18446744 TB"
            ]
        );
    }

    #[test]
    fn ages_have_one_unit() {
        let shown = [0, 119, 120, 7200, 172_800].map(|seconds| age(Duration::from_secs(seconds)));
        assert_eq!(shown, ["0 s", "119 s", "2 min", "2 h", "2 days"]);
    }
}
