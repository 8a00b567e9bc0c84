// The cloth that both engines build: a square grid of equal masses, lying horizontally, with edges between
// neighbours in rows and columns, along both diagonals, and between vertices two apart.

export const width = 2; // metres

export function vertices(side) {
    const spacing = width / (side - 1);
    return Array.from({ length: side * side }, (_, i) => {
        const column = i % side;
        const row = Math.floor(i / side);
        return [column * spacing - width / 2, 0, width / 2 - row * spacing];
    });
}

// Pairs of vertices, as a game would list them: cell by cell.
export function edges(side) {
    const offsets = [[1, 0], [0, 1], [1, 1], [-1, 1], [2, 0], [0, 2]];
    const pairs = [];
    for (let row = 0; row < side; ++row) {
        for (let column = 0; column < side; ++column) {
            for (const [across, down] of offsets) {
                const other = [column + across, row + down];
                if (other.every((place) => place >= 0 && place < side)) {
                    pairs.push([row * side + column, other[1] * side + other[0]]);
                }
            }
        }
    }
    return pairs;
}

// How a game may have come to list them. Jolt keeps much of the order that it is given, and its stretch
// depends on it a lot, its time hardly; Lockstitch makes an order of its own.
export const orders = {
    'from the pins': (pairs) => pairs,
    'to the pins': (pairs) => [...pairs].reverse(),
    // One direction after the other: edges of one direction are equally far apart in the numbering.
    'by family': (pairs) => [...pairs].sort(([a, b], [c, d]) => (b - a) - (d - c)),
};

export function pinned(side) {
    return [0, side - 1];
}

// |length / rest - 1| of all edges; `positions` are x, y, z a vertex.
export class Stretch {
    constructor(side) {
        this.edges = edges(side);
        this.rest = this.#lengths(vertices(side).flat());
    }

    of(positions) {
        let worst = 0;
        let squares = 0;
        this.#lengths(positions).forEach((length, i) => {
            const stretch = Math.abs(length / this.rest[i] - 1);
            worst = stretch <= worst ? worst : stretch; // NaN is the worst
            squares += stretch * stretch;
        });
        return { worst, rms: Math.sqrt(squares / this.edges.length) };
    }

    #lengths(positions) {
        return this.edges.map(([a, b]) => Math.hypot(positions[3 * a] - positions[3 * b],
            positions[3 * a + 1] - positions[3 * b + 1], positions[3 * a + 2] - positions[3 * b + 2]));
    }
}
