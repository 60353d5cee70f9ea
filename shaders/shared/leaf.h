// Layout header: which part of which curve a leaf stands for (source/scene/geometry.h holds the C++ side).
#ifndef STRANDLAB_LEAF_H
#define STRANDLAB_LEAF_H

struct Leaf {
    uint curve;
    uint interval;  // piece: bits 0..11, pieces: 12..23, flags: 24..31
};

const uint LEAF_BEGINS_STRAND = 1u;
const uint LEAF_ENDS_STRAND = 2u;

uint leaf_piece(Leaf leaf) { return leaf.interval & 4095u; }
uint leaf_pieces(Leaf leaf) { return (leaf.interval >> 12) & 4095u; }
uint leaf_flags(Leaf leaf) { return leaf.interval >> 24; }

#endif
