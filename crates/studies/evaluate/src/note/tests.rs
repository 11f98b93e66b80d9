use super::*;

#[test]
fn the_note_says_what_the_clusters_are_and_how_many_there_are_of_both() {
    let note = |recordings, points| {
        let note = Note::Clusters {
            recordings,
            points,
            least: 5,
        };
        note.to_string()
    };
    let few = note(3, 24);
    assert!(few.contains("24 contact points of 3 recordings"), "{few}");
    assert!(few.contains("by contact point do not show"), "{few}");
    let enough = note(5, 40);
    assert!(
        enough.contains("(5 recordings with 40 contact points)"),
        "{enough}"
    );
    assert!(enough.contains("5 are few") && enough.contains("4 degrees of freedom"));
    assert!(!note(12, 99).contains("few"));
}
