use super::*;

#[test]
fn an_error_is_small_enough_to_be_returned_everywhere() {
    assert!(size_of::<DatasetError>() <= 128);
}
