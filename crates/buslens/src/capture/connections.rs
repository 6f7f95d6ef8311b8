use std::collections::HashMap;
use std::net::SocketAddr;

use etherparse::TcpSlice;

use super::packets::Packet;

/// Two ends that talk.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Connection {
    /// Who opened it; where that was not captured, the end that is no usual server.
    pub client: SocketAddr,
    pub server: SocketAddr,
}

impl Connection {
    fn ports(&self) -> [u16; 2] {
        [self.client.port(), self.server.port()]
    }
}

/// What one end of a connection sent, in order.
#[derive(Debug)]
pub struct Segment<'a> {
    /// Microseconds since 1970, or as a text says.
    pub time: Option<i64>,
    /// Number of the connection, from 0; one that no connection has for a serial line.
    pub connection: usize,
    pub from_client: bool,
    /// The ports of client and server.
    pub ports: [u16; 2],
    /// Where in the file the packet is that it came in.
    pub offset: u64,
    /// The line of a text that the packet begins in; 0 in a file of packets.
    pub line: u32,
    pub bytes: &'a [u8],
    /// Bytes before it were not captured.
    pub gap: bool,
    /// It is whole by itself, as a datagram is.
    pub datagram: bool,
    /// It is of a serial line: there is no connection, and whether whoever wrote the file sent it.
    pub serial: Option<Option<bool>>,
}

impl<'a> Segment<'a> {
    /// What a serial line carried.
    pub(super) fn of_line(packet: &Packet<'_>, bytes: &'a [u8]) -> Self {
        Self {
            time: packet.time,
            connection: MOST,
            from_client: false,
            ports: [0; 2],
            offset: packet.offset,
            line: packet.line,
            bytes,
            gap: false,
            datagram: true,
            serial: Some(packet.sent),
        }
    }
}

/// Puts what connections carry in order.
#[derive(Debug, Default)]
pub struct Connections {
    list: Vec<Connection>,
    known: HashMap<(SocketAddr, SocketAddr), usize>,
    /// Both directions of each connection, the client's first.
    ways: Vec<[Way; 2]>,
    /// How many more there were than are kept.
    left_out: usize,
}

/// One direction of a connection.
#[derive(Debug, Default)]
struct Way {
    /// The sequence number that comes next.
    next: Option<u32>,
    /// Segments behind a gap.
    held: Vec<Held>,
    held_bytes: usize,
}

#[derive(Debug)]
struct Held {
    number: u32,
    time: Option<i64>,
    offset: u64,
    line: u32,
    bytes: Vec<u8>,
}

/// So much is held behind a gap; then the gap counts as lost.
const MOST_HELD: usize = 64;
const MOST_HELD_BYTES: usize = 1 << 18;

/// So many connections are kept, so that their numbers take two bytes; more are only counted.
pub const MOST: usize = 60_000;

/// The number of a connection that is not kept.
const LEFT_OUT: usize = usize::MAX;

/// The usual port of Modbus TCP.
const MODBUS: u16 = 502;

impl Connections {
    pub fn list(&self) -> &[Connection] {
        &self.list
    }

    /// How many connections there are beyond those of the [`list`](Self::list).
    pub fn left_out(&self) -> usize {
        self.left_out
    }

    /// Takes a TCP segment.
    pub fn tcp(
        &mut self,
        packet: &Packet<'_>,
        (from, to): (SocketAddr, SocketAddr),
        tcp: &TcpSlice<'_>,
        sink: &mut dyn FnMut(Segment<'_>),
    ) {
        let opens = tcp.syn() && !tcp.ack();
        let number = tcp.sequence_number();
        // The same ends open a new connection only with another first number.
        let fresh = opens
            && self.known.get(&(from, to)).is_some_and(|known| {
                self.ways
                    .get(*known)
                    .is_some_and(|ways| ways[0].next.is_some_and(|next| next != number.wrapping_add(1)))
            });
        if fresh && let Some(known) = self.known.remove(&(from, to)) {
            self.known.remove(&(to, from));
            self.flush(known, sink);
        }
        let Some((connection, from_client)) = self.connection(from, to, opens, tcp.syn() && tcp.ack()) else {
            return;
        };
        let way = usize::from(!from_client);
        if tcp.syn() {
            self.ways[connection][way].next = Some(number.wrapping_add(1));
            return;
        }
        if !tcp.payload().is_empty() {
            self.take(connection, way, number, packet, tcp.payload(), sink);
        }
    }

    /// Takes a UDP datagram.
    pub fn udp(
        &mut self,
        packet: &Packet<'_>,
        (from, to): (SocketAddr, SocketAddr),
        payload: &[u8],
        sink: &mut dyn FnMut(Segment<'_>),
    ) {
        if payload.is_empty() {
            return;
        }
        let Some((connection, from_client)) = self.connection(from, to, false, false) else { return };
        let Packet { time, offset, line, .. } = *packet;
        sink(Segment {
            time,
            connection,
            from_client,
            ports: self.list[connection].ports(),
            offset,
            line,
            bytes: payload,
            gap: false,
            datagram: true,
            serial: None,
        });
    }

    /// The file ends.
    pub fn finish(&mut self, sink: &mut dyn FnMut(Segment<'_>)) {
        for connection in 0..self.list.len() {
            self.flush(connection, sink);
        }
    }

    /// The number of the connection between two ends, and whether `from` is its client; `None` if it
    /// is one too many.
    fn connection(
        &mut self,
        from: SocketAddr,
        to: SocketAddr,
        opens: bool,
        accepts: bool,
    ) -> Option<(usize, bool)> {
        if let Some(known) = self.known.get(&(from, to)) {
            return Some((*known, self.list.get(*known)?.client == from));
        }
        let from_client = match () {
            () if opens => true,
            () if accepts => false,
            () if (from.port() == MODBUS) != (to.port() == MODBUS) => to.port() == MODBUS,
            () => from.port() >= to.port(),
        };
        let (client, server) = if from_client { (from, to) } else { (to, from) };
        let fresh = self.list.len();
        let number = if fresh < MOST { fresh } else { LEFT_OUT };
        self.known.insert((from, to), number);
        self.known.insert((to, from), number);
        if number == LEFT_OUT {
            self.left_out += 1;
            return None;
        }
        self.list.push(Connection { client, server });
        self.ways.push(Default::default());
        Some((number, from_client))
    }

    /// Takes bytes whose first has this sequence number.
    fn take(
        &mut self,
        connection: usize,
        way: usize,
        number: u32,
        packet: &Packet<'_>,
        bytes: &[u8],
        sink: &mut dyn FnMut(Segment<'_>),
    ) {
        let state = &mut self.ways[connection][way];
        let next = *state.next.get_or_insert(number);
        let Packet { time, offset, line, .. } = *packet;
        // Numbers wrap around: the distance tells which is before.
        let ahead = number.wrapping_sub(next) as i32;
        if ahead > 0 {
            state.held_bytes += bytes.len();
            state.held.push(Held { number, time, offset, line, bytes: bytes.to_vec() });
            if state.held.len() > MOST_HELD || state.held_bytes > MOST_HELD_BYTES {
                self.give_up_gap(connection, way, sink);
            }
            return;
        }
        let known = ahead.unsigned_abs() as usize;
        if let Some(fresh) = bytes.get(known..).filter(|fresh| !fresh.is_empty()) {
            // A payload has fewer bytes than there are numbers.
            state.next = Some(next.wrapping_add(fresh.len() as u32));
            let from_client = way == 0;
            sink(Segment {
                time,
                connection,
                from_client,
                ports: self.list[connection].ports(),
                offset,
                line,
                bytes: fresh,
                gap: false,
                datagram: false,
                serial: None,
            });
        }
        self.go_on(connection, way, sink);
    }

    /// Gives what was held and now fits.
    fn go_on(&mut self, connection: usize, way: usize, sink: &mut dyn FnMut(Segment<'_>)) {
        loop {
            let state = &mut self.ways[connection][way];
            let Some(next) = state.next else { return };
            let fits = |held: &Held| (held.number.wrapping_sub(next) as i32) <= 0;
            let Some(at) = state.held.iter().position(fits) else { return };
            let held = state.held.swap_remove(at);
            state.held_bytes -= held.bytes.len();
            let known = next.wrapping_sub(held.number) as usize;
            if let Some(fresh) = held.bytes.get(known..).filter(|fresh| !fresh.is_empty()) {
                state.next = Some(next.wrapping_add(fresh.len() as u32));
                let Held { time, offset, line, .. } = held;
                sink(Segment {
                    time,
                    connection,
                    from_client: way == 0,
                    ports: self.list[connection].ports(),
                    offset,
                    line,
                    bytes: fresh,
                    gap: false,
                    datagram: false,
                    serial: None,
                });
            }
        }
    }

    /// What is missing was not captured: goes on behind it.
    fn give_up_gap(&mut self, connection: usize, way: usize, sink: &mut dyn FnMut(Segment<'_>)) {
        let state = &mut self.ways[connection][way];
        let Some(next) = state.next else { return };
        let nearest = state.held.iter().enumerate().min_by_key(|(_, held)| held.number.wrapping_sub(next));
        let Some(at) = nearest.map(|(at, _)| at) else { return };
        let Held { number, time, offset, line, bytes } = state.held.swap_remove(at);
        state.held_bytes -= bytes.len();
        state.next = Some(number.wrapping_add(bytes.len() as u32));
        sink(Segment {
            time,
            connection,
            from_client: way == 0,
            ports: self.list[connection].ports(),
            offset,
            line,
            bytes: &bytes,
            gap: true,
            datagram: false,
            serial: None,
        });
        self.go_on(connection, way, sink);
    }

    fn flush(&mut self, connection: usize, sink: &mut dyn FnMut(Segment<'_>)) {
        for way in 0..2 {
            while !self.ways[connection][way].held.is_empty() {
                self.give_up_gap(connection, way, sink);
            }
        }
    }
}
