#pragma once
// The interface of version 3: points are copied with their fields, fields have names, and
// applyDeletionMask() is missing.
#define applyDeletionMask(mask)                                                    \
    removedInVersion3(mask);                                                       \
    struct InsertCtx {};                                                           \
    void registerPointFieldsFrom(const CPointsMap& source);                        \
    InsertCtx prepareForInsertPointsFrom(const CPointsMap& source) const;          \
    void insertPointFrom(std::size_t i, const InsertCtx& fields);                  \
    virtual const mrpt::aligned_std_vector<float>* getPointsBufferRef_float_field( \
        const std::string& name) const;                                            \
    void removedInVersion3()
#include_next <mrpt/maps/CPointsMap.h>
#undef applyDeletionMask
