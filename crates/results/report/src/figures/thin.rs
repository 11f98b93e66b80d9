//! Selects the samples to draw.

/// Positions of the samples to draw, ascending: all of up to `most`. Of more, evenly spaced rows, and the largest errors as a tenth of
/// `most`, so that outliers stay visible.
pub(crate) fn thin(errors: &[f64], most: usize) -> Vec<usize> {
    if errors.len() <= most {
        return (0..errors.len()).collect();
    }
    let worst = most / 10;
    let even = most - worst;
    let mut by_error: Vec<usize> = (0..errors.len()).collect();
    by_error.sort_by(|a, b| errors[*b].abs().total_cmp(&errors[*a].abs()).then(a.cmp(b)));
    let mut drawn: Vec<usize> = by_error[..worst].to_vec();
    drawn.extend((0..even).map(|at| at * errors.len() / even));
    drawn.sort_unstable();
    drawn.dedup();
    drawn
}

/// The rule of [`thin`] in words.
pub(crate) fn rule(drawn: usize, all: usize) -> String {
    if drawn == all {
        format!("{all} samples, all drawn")
    } else {
        format!(
            "{all} samples, {drawn} drawn: evenly spaced ones and those with the largest errors"
        )
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn few_are_all_drawn_and_of_many_the_worst_are_never_lost() {
        assert_eq!(thin(&[1.0, 2.0], 10), [0, 1]);
        let mut errors = vec![0.0; 100_000];
        errors[77_777] = -3.0;
        let drawn = thin(&errors, 100);
        assert!(drawn.len() <= 100 && drawn.contains(&77_777) && drawn.contains(&0));
    }
}
