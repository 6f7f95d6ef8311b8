//! The lessons that come with Buslens, in the order in which they are best taken.

/// Their texts.
pub static LESSONS: &[&str] = &[
    include_str!("../../../../lessons/bytes.txt"),
    include_str!("../../../../lessons/request.txt"),
    include_str!("../../../../lessons/registers.txt"),
    include_str!("../../../../lessons/floats.txt"),
    include_str!("../../../../lessons/crc.txt"),
    include_str!("../../../../lessons/exceptions.txt"),
    include_str!("../../../../lessons/logs.txt"),
    include_str!("../../../../lessons/framing.txt"),
    include_str!("../../../../lessons/timing.txt"),
    include_str!("../../../../lessons/memograph.txt"),
    include_str!("../../../../lessons/mapping.txt"),
    include_str!("../../../../lessons/channel.txt"),
    include_str!("../../../../lessons/startup.txt"),
];
