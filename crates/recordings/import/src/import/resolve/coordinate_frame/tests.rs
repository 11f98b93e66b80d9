use super::*;

#[test]
fn what_stands_before_the_name_of_a_frame_is_what_its_numbers_begin_with() {
    for (column, expected) in [
        ("header.frame_id", ""),
        ("frame_id", ""),
        ("child_frame_id", ""),
        ("/header/frame_id", "/"),
        ("wrench.header.frame_id", "wrench."),
        ("pose.child_frame_id", "pose."),
        ("ft_frame_id", "ft_"),
        ("é.frame_id", "é."),
    ] {
        assert_eq!(prefix(column), expected, "{column}");
    }
}
