//! Reports as text.

use super::example::analyse;

#[test]
fn the_text_has_every_component_with_its_interval_and_the_remarks() {
    let text = analyse(|settings| {
        settings.unit = "mm".to_owned();
        settings.draws = 200_000;
    })
    .to_string();
    let lines: Vec<&str> = text.lines().collect();
    assert_eq!(
        lines[0],
        "10 parts, 3 operators, 3 trials; intervals of 95 %"
    );
    assert!(lines[1].contains("sd, mm") && lines.len() == 12, "{text}");
    let gauge = lines
        .iter()
        .find(|line| line.starts_with("gauge (R&R)"))
        .expect("a line");
    assert!(
        gauge.contains("0.3024 [0.2234, 1.457]") && gauge.contains("27.86 [15."),
        "{gauge}"
    );
    assert!(text.contains("distinct categories: 4.875 [1.0"), "{text}");
    assert!(text.contains("rounded down to 4"), "{text}");
    assert!(text.contains("note: reproducibility has only 2 degrees of freedom, from 3 operators"));
    assert!(text.contains("note: interaction pooled with repeatability: p = 0.974 is above 0.25"));
}
