//! Scores of classes.

use taceva_tasks::Classes;

#[test]
fn a_merge_has_the_samples_of_both_states() -> Result<(), Box<dyn std::error::Error>> {
    let mut first = Classes::new(["no_slip", "slip"], Some("slip"))?;
    first.push("a", "slip", "no_slip")?;
    let mut second = Classes::new(["no_slip", "slip"], Some("slip"))?;
    second.push_positions("a", &[1, 0], &[1, 0])?;
    let merged = first.merge(second)?;
    assert_eq!((merged.n(), merged.confusion().len()), (3, 3));
    Ok(())
}
