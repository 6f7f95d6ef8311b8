//! The lessons that come with Buslens, in the order in which they are best taken.

/// Their texts.
pub static LESSONS: &[&str] = &[
    include_str!("../../../../lessons/bytes.txt"),
    include_str!("../../../../lessons/request.txt"),
    include_str!("../../../../lessons/registers.txt"),
];
