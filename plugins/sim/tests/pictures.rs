//! What the pictures of the simulated sensors promise.

mod pictures {
    mod camera;
    mod gels;
    mod support;
}
